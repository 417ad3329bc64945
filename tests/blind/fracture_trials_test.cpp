// Blind trials of fracture tests beside moduli. The virtual laboratory, with numerics and constants of its own, pulls specimens of a single unit; `nacre diagnose`
// sees the measurement set alone.

#include <gtest/gtest.h>

#include "blind_trial.hpp"

namespace nacre::blind {
namespace {

constexpr int kPatterns = 12, kTwins = 3;

/// Random patterns over the strata, three of them turned too, each for both tests.
std::vector<virtual_laboratory::Question> fracture_questions(std::uint64_t seed) {
  std::vector<virtual_laboratory::Question> questions;
  for (const auto test : {tester::TestKind::modulus, tester::TestKind::toughness}) {
    for (virtual_laboratory::Question question : printed(seed, kPatterns, kTwins, {})) {
      question.test = test;
      question.fidelity = tester::Fidelity::tiny;
      questions.push_back(question);
    }
  }
  return questions;
}

Trial play(const std::string& laboratory) { return run_trial(laboratory, fracture_questions, "tiny --search 24"); }

std::string laboratory(int seed, const std::string& effect = "", const std::string& value = "") {
  return laboratory_file(seed, "tiny", "modulus = 0.01\ntoughness = 0.04\nstrain = 0.01\n", effect, value);
}

TEST(BlindFractureTrials, NothingHiddenIsBaseSufficient) {
  const Trial trial = play(laboratory(41));
  EXPECT_EQ(trial.diagnosis["verdict"], "base_sufficient") << trial.diagnosis["summary"];
}

// Slack shows in curves only: moduli are given as numbers.
TEST(BlindFractureTrials, SlackOfTheGripsIsFoundFromCurves) { expect_found(play(laboratory(42, "toe_slack", "0.008")), "toe_slack", 0.008, 0.2); }

TEST(BlindFractureTrials, MachineComplianceIsFoundFromModuliAndCurvesTogether) { expect_found(play(laboratory(43, "machine_compliance", "3e-10")), "machine_compliance", 3e-10, 0.25); }

// A factor on force is what the constants of the materials take over, whatever is measured.
TEST(BlindFractureTrials, AnErrorOfTheLoadCellCannotBeTold) {
  const Trial trial = play(laboratory(44, "load_cell_gain", "0.1"));
  EXPECT_EQ(trial.diagnosis["verdict"], "base_sufficient") << trial.diagnosis["summary"];
  for (const auto& candidate : trial.diagnosis["candidates"])
    if (candidate["name"] == "load_cell_gain") EXPECT_EQ(candidate["status"], "invisible");
}

}  // namespace
}  // namespace nacre::blind
