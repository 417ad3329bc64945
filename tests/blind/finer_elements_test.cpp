// Measurements on a refined mesh: a diagnosis has to take them for discretisation error and not for an effect.

#include <gtest/gtest.h>

#include "../unit/diagnosis/synthetic_set.hpp"
#include "diagnosis/diagnose.hpp"

namespace nacre::diagnosis {
namespace {

/// Specimens on elements of half the size.
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

// With layouts taken as independent the size was estimated 39 % too small.
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

// Edges of grown regions fall between the elements differently at every size: 0.24 and 0.30 pixels explain these moduli
// nearly equally well. With the discretisation error of the base's fit the size was 0.240 (0.224 to 0.256).
TEST(FinerElements, LeaveGrowthItsSize) {
  material::ParameterSet truth = material::default_parameters();
  truth.modulus = {.e_tb_pa = 0.99e6, .e_vw_pa = 2.63e9, .e_if_pa = 6e8, .nu_tb = 0.42, .nu_vw = 0.25, .nu_if = 0.32};
  truth.extensions["rigid_overprint"] = {0.30};
  const Diagnosis diagnosis = diagnose_on_finer_elements(truth);
  ASSERT_EQ(to_string(diagnosis.verdict), "named") << diagnosis.summary;
  ASSERT_EQ(diagnosis.effects.size(), 1u) << diagnosis.summary;
  EXPECT_EQ(diagnosis.effects[0].name, "rigid_overprint");
  EXPECT_NEAR(diagnosis.effects[0].parameter, 0.30, 0.03) << diagnosis.summary;
  EXPECT_LT(diagnosis.effects[0].interval_low, 0.30) << diagnosis.summary;
  EXPECT_GT(diagnosis.effects[0].interval_high, 0.30) << diagnosis.summary;
}

}  // namespace
}  // namespace nacre::diagnosis
