#include "blind_trials/pool.hpp"

#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "base/files.hpp"
#include "blind_trials/broken_trials.hpp"
#include "laboratory/draw.hpp"

namespace nacre::blind_trials {
namespace {

namespace lab = laboratory;

TEST(Pool, IsSimulatedOnceAndMendedWhereItWasCutOff) {
  lab::Truth truth = lab::draw_truth(5, tester::Fidelity::tiny);
  std::vector<lab::Experiment> experiments;
  for (const char* name : {"rigid", "interface", "mix:0.8"})
    experiments.push_back({.design = *pattern::design_from_name(name),
                           .test = tester::TestKind::toughness,
                           .fidelity = tester::Fidelity::tiny,
                           .specimens = 2});
  const auto folder = std::filesystem::temp_directory_path() / "nacre-pool-test";
  std::filesystem::remove_all(folder);
  const auto file = folder / "pool.jsonl";
  const auto first = pooled_responses(truth, experiments, file);
  ASSERT_TRUE(first[2].has_value());
  EXPECT_EQ(first[2]->other_curves.size(), 1u);
  truth.toughness.w_vw_j_per_m3 *= 2.0;  // what is known is not asked again
  EXPECT_EQ(pooled_responses(truth, experiments, file)[2]->curve, first[2]->curve);
  const std::string whole = read_file(file);
  write_file_atomically(file, whole.substr(0, whole.size() - 40));
  const auto mended = pooled_responses(truth, experiments, file);
  int other = 0;
  for (std::size_t i = 0; i < experiments.size(); ++i) other += mended[i]->curve == first[i]->curve ? 0 : 1;
  EXPECT_EQ(other, 1) << "the last line alone, by the truth as it is now";
  EXPECT_EQ(pooled_responses(truth, experiments, file)[2]->curve, mended[2]->curve);
  std::filesystem::remove_all(folder);
}

TEST(BrokenTrials, ShareTruthsAndOrderSpecimensByThemselves) {
  TrialOptions options;
  options.fracture_nulls = 12;
  options.fracture_seeds = 2;
  std::set<std::uint64_t> truths, seeds;
  const BlindTrial* before = nullptr;
  const std::vector<BlindTrial> all = all_trials(options);
  int count = 0, others = 0;
  for (const BlindTrial& trial : all) {
    if (trial.kind != "fracture") continue;
    ++count;
    truths.insert(trial.truth_seed);
    seeds.insert(trial.seed);
    if (before && before->truth_seed == trial.truth_seed) {
      EXPECT_EQ(before->hidden, trial.hidden);
      EXPECT_EQ(truth_of(*before, options).effects, truth_of(trial, options).effects);
      others += drawn_from_pool(*before, 0) != drawn_from_pool(trial, 0) ? 1 : 0;
    }
    before = &trial;
  }
  EXPECT_EQ(count, 12 + 2 * 16);
  EXPECT_GT(others, 20) << "of 26 that follow one of the same truth";
  EXPECT_EQ(truths.size(), 2u + 16u) << "ten nulls share one, and the trials of an effect and size";
  EXPECT_EQ(seeds.size(), static_cast<std::size_t>(count));
}

}  // namespace
}  // namespace nacre::blind_trials
