#pragma once
// One laboratory with its measurements, split into fitted and held-out designs.

#include <chrono>
#include <functional>

#include "commands.hpp"
#include "laboratory/truth.hpp"
#include "measurement/summary.hpp"
#include "sysid/local_simulator.hpp"
#include "sysid/offline.hpp"

namespace nacre::calibration_study {

struct StudyCase {
  laboratory::Truth truth;
  std::vector<measurement::Replicates> fitted, held_out;
};

/// A function that throws TimeIsUp when `minutes` have passed since this call.
std::function<void()> deadline(double minutes);

/// Simulates the measurements that the work folder lacks.
StudyCase measured_case(std::uint64_t seed, const Options& options, const std::function<void()>& may_go_on);

/// A simulator at `fidelity` (by its name) that keeps its simulations in the work folder.
sysid::LocalSimulator kept_simulator(const Options& options, const std::string& fidelity);

}  // namespace nacre::calibration_study
