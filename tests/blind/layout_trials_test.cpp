// Two trials of the study's second report (docs/studies/blind_trials, docs/decisions/0017) that were missed there:
// layouts with coupons, and rigid regions that grow by little.

#include <gtest/gtest.h>

#include "blind_trial.hpp"
#include "blind_trials/trial_diagnosis.hpp"

namespace nacre::blind {
namespace {

/// Prints, measures, diagnoses and opens the trial that the study calls by this name: constants, designs, scatter and
/// hidden size follow from name and seed.
blind_trials::TrialDiagnosis diagnosis_of(const std::string& name, std::uint64_t seed, bool noisy) {
  const Scratch scratch;
  const blind_trials::BlindTrial trial{
      .name = name, .kind = "effect", .seed = seed, .large = false, .noisy = noisy, .hidden = {"rigid_overprint"}};
  blind_trials::TrialOptions options;
  options.program = std::string(NACRE_BINARY_DIR) + "/nacre";
  blind_trials::generate(trial, options, scratch.folder());
  blind_trials::diagnose(trial, options, scratch.folder());
  return blind_trials::open_trial(trial, "", scratch.folder());
}

TEST(BlindLayoutTrials, SmallGrowthOfRigidRegionsIsNamed) {
  const auto diagnosis = diagnosis_of("effect-rigid_overprint-small-noisy-41093033219", 41093033219, true);
  ASSERT_EQ(diagnosis.verdict, "named");
  ASSERT_EQ(diagnosis.named.size(), 1u);
  EXPECT_EQ(diagnosis.named[0].effect, "rigid_overprint");
  EXPECT_NEAR(diagnosis.named[0].size, diagnosis.hidden[0].size, 0.3 * diagnosis.hidden[0].size);
}

// By the moduli of these layouts plane strain 0.94 fits as well as growth by 0.078 pixels does; the coupons beside them
// say how far E of a layout's materials may lie from theirs, and that decides.
TEST(BlindLayoutTrials, CouponsDecideBetweenCausesThatFitLayoutsEquallyWell) {
  const auto diagnosis = diagnosis_of("effect-rigid_overprint-small-41093033215", 41093033215, false);
  EXPECT_EQ(diagnosis.verdict, "named");
  ASSERT_EQ(diagnosis.named.size(), 1u);
  EXPECT_EQ(diagnosis.named[0].effect, "rigid_overprint");
  EXPECT_NEAR(diagnosis.named[0].size, diagnosis.hidden[0].size, 0.3 * diagnosis.hidden[0].size);
}

}  // namespace
}  // namespace nacre::blind
