// Measurements from elements of half the size: what a diagnosis has to call numerics and not an effect.

#include <gtest/gtest.h>

#include "../unit/diagnosis/synthetic_set.hpp"
#include "diagnosis/diagnosis.hpp"

namespace nacre::diagnosis {
namespace {

/// Specimens on elements of half the size: what the diagnosis has to call numerics.
Diagnosis diagnose_on_finer_elements(const material::ParameterSet& truth) {
  SyntheticSet set;
  set.patterns = 14;
  set.replicates = 4;
  set.noise = 0.01;
  set.refinement = 2;
  DiagnosisSettings settings;
  settings.start = material::default_parameters();
  settings.fidelity = tester::Fidelity::tiny;
  settings.floor = {.log_modulus_sd = 0.006, .mesh_amplitude = 1.7, .mesh_remainder_sd = 0.003};
  return diagnose(synthetic_specimens(set, truth), settings);
}

TEST(FinerElements, OfOneTruthAreNoEffect) {
  const Diagnosis diagnosis = diagnose_on_finer_elements(synthetic_truth());
  EXPECT_EQ(to_string(diagnosis.verdict), "base_sufficient") << diagnosis.summary;
}

// With layouts taken as independent the size came out 39 % too small.
TEST(FinerElements, LeaveDropletMixingItsSize) {
  material::ParameterSet truth = synthetic_truth();
  truth.extensions["droplet_mixing"] = {0.6};
  const Diagnosis diagnosis = diagnose_on_finer_elements(truth);
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  ASSERT_EQ(diagnosis.effects.size(), 1u) << diagnosis.summary;
  EXPECT_EQ(diagnosis.effects[0].name, "droplet_mixing");
  EXPECT_NEAR(diagnosis.effects[0].parameter, 0.6, 0.15);
  ASSERT_TRUE(diagnosis.gain);
  EXPECT_LT(diagnosis.gain->held_out_error_after, diagnosis.gain->held_out_error_before);
}

}  // namespace
}  // namespace nacre::diagnosis
