// Fracture tests of eight layouts, diagnosed with an emulator that is simulated once and kept.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "base/expected.hpp"
#include "base/files.hpp"
#include "blind_trial.hpp"

namespace nacre::blind {
namespace {

/// Broken at one rate, from stiff to soft.
std::vector<laboratory::Experiment> notched_layouts(std::uint64_t) {
  std::vector<laboratory::Experiment> experiments;
  for (const char* name : {"7be56cbdab2b13", "5bbbe93cfcc6d9", "5a77ffffe9f9df", "4fedbf7fffbdff", "3897af7c216fd9",
                           "0dfff39f70f13b", "67db5ae75bfa5f", "7df3fb67ffbecf"})
    experiments.push_back({.design = expected(pattern::design_from_name(name)),
                           .test = tester::TestKind::toughness,
                           .specimens = kReplicates});
  return experiments;
}

/// Replicates are specimens: beyond their own variation nothing scatters.
std::string laboratory(int seed, const std::string& effect = "", const std::string& value = "") {
  return laboratory_file(seed, "tiny", "modulus = 0\ntoughness = 0\nstrain = 0\n", effect, value);
}

class BlindFractureTrials : public testing::Test {
 protected:
  static void SetUpTestSuite() { scratch_ = std::make_unique<Scratch>(); }
  static void TearDownTestSuite() { scratch_.reset(); }
  static OpenedTrial trial_of(const std::string& laboratory) {
    const std::string options =
        fmt::format("--kept-emulator --params {} --store {}", NACRE_SOURCE_DIR "/bench/blind_trials/fracture.toml",
                    (scratch_->folder() / "emulator.store").string());
    const auto one_batch = [](const laboratory::Experiment&, int) { return 0; };
    return run_trial(laboratory, notched_layouts, "tiny", one_batch, options);
  }

 private:
  static std::unique_ptr<Scratch> scratch_;  ///< the emulator is simulated once, for all trials
};
std::unique_ptr<Scratch> BlindFractureTrials::scratch_;

TEST_F(BlindFractureTrials, AYieldOfTheRigidMaterialIsNamed) {
  const OpenedTrial trial = trial_of(laboratory(202, "rigid_yield", "2e7"));
  expect_found(trial, "rigid_yield", 2e7, 0.25);
}

TEST_F(BlindFractureTrials, WithNothingHiddenTheBaseIsSufficientAndNothingIsSimulatedAnew) {
  const OpenedTrial trial = trial_of(laboratory(301));
  EXPECT_EQ(trial.diagnosis["verdict"], "base_sufficient") << trial.diagnosis["summary"];
  EXPECT_EQ(trial.diagnosis["simulations"], 0);
}

}  // namespace
}  // namespace nacre::blind
