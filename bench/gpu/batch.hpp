#pragma once

#include <memory>
#include <vector>

#include "gpu/batch_tester.hpp"
#include "tester/toughness.hpp"

namespace nacre::gpu_study {

/// The accelerator of this machine, or with `emulated` this processor in its place. Throws InputError where there is
/// none.
std::unique_ptr<gpu::Device> device_with(int places, bool emulated);

/// Places that a device of this machine should have for specimens like `typical`, at most `most`. Makes a device of one
/// place to ask for its memory.
int places_on_device(const tester::FractureTest& typical, int most, bool emulated);

struct BatchTimes {
  double preparing_s = 0.0;  ///< mounting the specimens, all processors at work
  double pulling_s = 0.0;    ///< from the first specimen on the device to the last one off it
};

/// All tests through a batch of `places`, results in their order.
std::vector<Result<tester::ToughnessResult>> pull_all(std::unique_ptr<gpu::Device> device, int places,
                                                      const std::vector<tester::FractureTest>& tests,
                                                      BatchTimes& times);

}  // namespace nacre::gpu_study
