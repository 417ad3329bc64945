#include "surrogate/network.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "base/result.hpp"
#include "base/statistics.hpp"
#include "pattern/random_pattern.hpp"

namespace nacre::surrogate {
namespace {

/// Small and quick; the architecture is that of Figure 2-10.
EnsembleSettings small_ensemble() {
  EnsembleSettings settings;
  settings.network.channels = 8;
  settings.network.residual_blocks = 1;
  settings.network.epochs = 40;
  settings.network.batch = 64;
  settings.network.weight_decay = 1e-4;
  return settings;
}

struct PatternProblem {
  std::vector<pattern::Pattern> patterns;
  std::vector<double> values;
  Samples samples() const { return {patterns, values}; }
};

/// Soft pixels next to rigid ones.
PatternProblem some_problem(int count, std::uint64_t seed) {
  RandomStream random(seed, "test");
  PatternProblem problem;
  for (int i = 0; i < count; ++i) {
    const pattern::Pattern pattern = pattern::random_pattern(random);
    double edges = 0.0;
    for (int r = 0; r < 10; ++r)
      for (int c = 0; c + 1 < 10; ++c) edges += pattern.rigid(r, c) != pattern.rigid(r, c + 1);
    problem.patterns.push_back(pattern);
    problem.values.push_back(3.0 + 0.1 * edges);
  }
  return problem;
}

TEST(Networks, WithoutLibtorchTheyAreRefusedWithAReason) {
  if (networks_available()) GTEST_SKIP() << "this build has networks";
  EXPECT_THROW(make_network({}), InputError);
}

class WithNetworks : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!networks_available()) GTEST_SKIP() << "this build has no networks (libtorch-dev)";
  }
};

TEST_F(WithNetworks, LearnWhatNeighbouringPixelsDecide) {
  const PatternProblem learnt = some_problem(300, 1), unseen = some_problem(100, 2);
  const auto ensemble = fit_ensemble(learnt.samples(), 300, small_ensemble());
  EXPECT_GT(rank_correlation(ensemble->means(unseen.patterns), unseen.values), 0.8);
}

TEST_F(WithNetworks, EqualSeedsGiveEqualBitsWithAndWithoutMemory) {
  const PatternProblem learnt = some_problem(60, 3);
  EnsembleSettings settings = small_ensemble();
  settings.warm_start = true;
  settings.members = 2;
  settings.network.epochs = 10;
  const auto first = fit_ensemble(learnt.samples(), 40, settings)->means(learnt.patterns);
  EXPECT_EQ(first, fit_ensemble(learnt.samples(), 40, settings)->means(learnt.patterns));
  settings.network.seed = 2;
  EXPECT_NE(first, fit_ensemble(learnt.samples(), 40, settings)->means(learnt.patterns));
}

TEST_F(WithNetworks, MembersDisagreeFarFromWhatTheyLearnt) {
  const PatternProblem learnt = some_problem(150, 4);
  EnsembleSettings settings = small_ensemble();
  settings.members = 3;
  const auto ensemble = fit_ensemble(learnt.samples(), 150, settings);
  std::vector<pattern::Pattern> far;  // nearly all soft, where the design space has half and more rigid
  for (int b = 0; b < pattern::kFreePixels; ++b) far.emplace_back(std::uint64_t{1} << b);
  double at_samples = 0.0, elsewhere = 0.0;
  for (const PatternPrediction& each : ensemble->predict(learnt.patterns)) at_samples += each.deviation / 150.0;
  for (const PatternPrediction& each : ensemble->predict(far)) elsewhere += each.deviation / pattern::kFreePixels;
  EXPECT_GT(elsewhere, 1.5 * at_samples);
}

TEST_F(WithNetworks, AWarmStartGoesOnFromWhatWasLearnt) {
  const PatternProblem learnt = some_problem(300, 6), unseen = some_problem(100, 7);
  EnsembleSettings settings = small_ensemble();
  settings.warm_start = true;
  const auto warm = fit_ensemble(learnt.samples(), 240, settings);
  EXPECT_GT(rank_correlation(warm->means(unseen.patterns), unseen.values), 0.8);
}

}  // namespace
}  // namespace nacre::surrogate
