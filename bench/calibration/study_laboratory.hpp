#pragma once
// A virtual laboratory whose responses are kept in a file: measuring goes on where it stopped.

#include <filesystem>
#include <functional>
#include <vector>

#include "laboratory/laboratory.hpp"
#include "measurement/specimen_record.hpp"

namespace nacre::calibration_study {

/// The truth of one laboratory of the study: constants and variation of strength drawn from the seed, no effects; its
/// material fails by `criterion`.
laboratory::Truth study_truth(std::uint64_t seed, tester::Fidelity fidelity, material::CriterionKind criterion);

/// The constants of such a truth as the testers' base model has them, W by its own criterion.
material::ParameterSet as_tester_parameters(const laboratory::Truth& truth);

/// Called between two simulations; throws to stop.
using MayGoOn = std::function<void()>;

/// All replicates of both tests of `designs`. Responses are read from `store` where it has them, and added to
/// it.
std::vector<measurement::SpecimenRecord> measure(const laboratory::Truth& truth,
                                                 const std::vector<pattern::Design>& designs,
                                                 const std::filesystem::path& store, const MayGoOn& may_go_on);

}  // namespace nacre::calibration_study
