// The result of a blind trial survives the way through the study's table.

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "base/result.hpp"
#include "blind_trials/score.hpp"
#include "laboratory/effect_kinds.hpp"

namespace nacre::blind_trials {
namespace {

BlindTrial trial_hiding(std::vector<std::string> hidden) {
  return {"double-a+b-large-7", "double", 7, true, false, std::move(hidden)};
}

TrialDiagnosis two_effects() {
  return {.commit = "abc1234",
          .verdict = "named",
          .hidden = {{3.33e-10, 29.4, 0.33, 1.0}, {-0.464, 12.0, 0.09, 0.99}},
          .named = {{"interface_anisotropy", -0.47, -0.5, -0.44}, {"machine_compliance", 3.26e-10, 3.11e-10, 3.40e-10}},
          .possible = {{"interface_anisotropy", "machine_compliance"}, {"droplet_mixing"}},
          .gain = 0.57,
          .p_misfit = 0.001};
}

TEST(TrialDiagnosis, GoesThroughItsCells) {
  const TrialDiagnosis before = two_effects(), after = diagnosis_from_cells(to_cells(before));
  EXPECT_EQ(to_cells(before).size() + 1, diagnosis_columns().size());
  EXPECT_EQ(to_cells(after), to_cells(before));
  EXPECT_EQ(after.possible, before.possible);
  ASSERT_EQ(after.hidden.size(), 2U);
  EXPECT_EQ(after.hidden[1].size, -0.464);
  EXPECT_EQ(after.named[1].low90, 3.11e-10);
  TrialDiagnosis nothing;
  nothing.verdict = "base_sufficient";
  const TrialDiagnosis null = diagnosis_from_cells(to_cells(nothing));
  EXPECT_TRUE(null.hidden.empty() && null.named.empty() && null.possible.empty());
  EXPECT_EQ(null.p_misfit, 1.0);
}

TEST(TrialDiagnosis, ACellThatIsNoNumberIsRefused) {
  std::vector<std::string> cells = to_cells(two_effects());
  cells[1] = "large;small";
  EXPECT_THROW(diagnosis_from_cells(cells), InputError);
  cells[1] = "0.1";
  EXPECT_THROW(diagnosis_from_cells(cells), InputError);
}

TEST(BlindScore, TheSizeIsThatOfTheFirstHiddenEffectWhereverItIsNamed) {
  const Score score = score_of(trial_hiding({"machine_compliance", "interface_anisotropy"}), two_effects());
  EXPECT_TRUE(score.right_name);
  EXPECT_TRUE(score.in_set);
  EXPECT_NEAR(score.parameter_error, 1.0 - 3.26 / 3.33, 1e-12);
  EXPECT_TRUE(score.covered);
}

TEST(BlindScore, AnotherNameIsWrong) {
  const Score score = score_of(trial_hiding({"toe_slack", "interface_anisotropy"}), two_effects());
  EXPECT_FALSE(score.right_name);
  EXPECT_FALSE(score.in_set);
  EXPECT_LT(score.parameter_error, 0.0);
  EXPECT_NE(report_of({score}).find("| two at once: a wrong name | 1 of 1"), std::string::npos);
}

TEST(BlindScore, AnotherFormOfAnEffectIsRightWithItsFamily) {
  TrialDiagnosis diagnosis;
  diagnosis.verdict = "named";
  diagnosis.hidden = {{0.3, 12.0, 0.0, 0.0}};
  diagnosis.named = {{"droplet_mixing", 0.8, 0.7, 0.9}};
  const BlindTrial form{"form-smooth_mixing-large-9", "form", 9, true, false, {"smooth_mixing"}};
  EXPECT_TRUE(score_of(form, diagnosis).right_family);
  diagnosis.named = {{"plane_strain", 0.8, 0.7, 0.9}};
  EXPECT_FALSE(score_of(form, diagnosis).right_family);
  EXPECT_NE(report_of({score_of(form, diagnosis)}).find("a name of another family | 1 of 1"), std::string::npos);
}

TEST(BlindScore, ANameWhereNothingIsHiddenIsOfNoFamily) {
  TrialDiagnosis diagnosis;
  diagnosis.verdict = "named";
  diagnosis.named = {{"droplet_mixing", 0.8, 0.7, 0.9}};
  const Score score = score_of({"null-nothing-large-1", "null", 1, true, false, {}}, diagnosis);
  EXPECT_FALSE(score.right_name || score.right_family);
  EXPECT_NE(report_of({score}).find("| nulls: any name | 1 of 1"), std::string::npos);
}

TEST(BlindTrials, OutsideAreUnmodelledCauses) {
  std::map<std::string, std::set<std::string>> hidden;
  for (const BlindTrial& trial : all_trials({}))
    for (const std::string& effect : trial.hidden) hidden[trial.kind].insert(effect);
  EXPECT_EQ(hidden["outside"].size(), 8u);
  EXPECT_EQ(hidden["form"].size(), 5u);
  EXPECT_EQ(hidden["even"].size(), 2u);
  for (const laboratory::EffectKind& kind : laboratory::effect_kinds()) {
    const std::string name(kind.name);
    const bool unknown = !kind.in_library && kind.family.empty();
    EXPECT_EQ(hidden["outside"].contains(name), unknown && !kind.even) << name;
    EXPECT_EQ(hidden["form"].contains(name), !kind.in_library && !kind.family.empty()) << name;
    EXPECT_EQ(hidden["even"].contains(name), unknown && kind.even) << name;
  }
}

}  // namespace
}  // namespace nacre::blind_trials
