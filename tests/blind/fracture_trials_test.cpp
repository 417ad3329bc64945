// Blind trials of notched specimens pulled to separation.

#include <gtest/gtest.h>

#include "blind_trial.hpp"

namespace nacre::blind {
namespace {

std::vector<laboratory::Experiment> broken_layouts(std::uint64_t seed) {
  std::vector<laboratory::Experiment> experiments = printed(seed, 12, 0, {});
  for (laboratory::Experiment& each : experiments) each.test = tester::TestKind::toughness;
  return experiments;
}

// The laboratory's elements fail by another criterion than the simulation's, so that its curves bend, peak and fall
// otherwise. Every one of them begins with the slack all the same.
TEST(BlindFractureTrials, ASlackIsNamedInALaboratoryWithACriterionOfItsOwn) {
  const std::string noise = "modulus = 0.015\ntoughness = 0.03\nstrain = 0.01\n";
  const OpenedTrial trial =
      run_trial(laboratory_file(205, "tiny", noise, "toe_slack", "0.004") + "[toughness]\ncriterion = \"element\"\n",
                broken_layouts, "tiny");
  expect_found(trial, "toe_slack", 0.004, 0.1);
}

}  // namespace
}  // namespace nacre::blind
