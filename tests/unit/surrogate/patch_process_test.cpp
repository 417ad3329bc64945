#include "surrogate/patch_process.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "../pattern/random_patterns.hpp"
#include "base/random.hpp"
#include "base/statistics.hpp"

namespace nacre::surrogate {
namespace {

using pattern::random_patterns;

/// Rewards what a crack would: soft corners between rigid neighbours, here and there; a function of neighbourhoods.
double local_quantity(const pattern::Pattern& pattern) {
  double sum = 0.0;
  for (int r = 0; r < pattern::kQuarter; ++r) {
    for (int c = 0; c < pattern::kQuarter; ++c) {
      sum += pattern.rigid(r, c) && !pattern.rigid(r + 1, c) && pattern.rigid(r, c + 1) ? 1.0 + 0.1 * r : 0.0;
    }
  }
  return std::log(1.0 + sum);
}

std::vector<double> values_of(const std::vector<pattern::Pattern>& patterns) {
  std::vector<double> values;
  for (const auto& pattern : patterns) values.push_back(local_quantity(pattern));
  return values;
}

/// The covariance by its definition, pixel by pixel.
double defined_covariance(const pattern::Pattern& a, const pattern::Pattern& b, const PatchKernel& kernel) {
  const auto differ = [&](int r, int c) {
    const auto inside = [](int i) { return i < 0 ? -1 - i : i > 9 ? 19 - i : i; };
    return a.rigid(inside(r), inside(c)) != b.rigid(inside(r), inside(c));
  };
  const auto window_mean = [&](int half, double decay) {
    double sum = 0.0;
    for (int r = 0; r < 10; ++r) {
      for (int c = 0; c < 10; ++c) {
        int different = 0;
        for (int i = -half; i <= half; ++i)
          for (int j = -half; j <= half; ++j) different += differ(r + i, c + j);
        sum += std::pow(decay, different) / 100.0;
      }
    }
    return sum;
  };
  int different = 0;
  for (int r = 0; r < 10; ++r)
    for (int c = 0; c < 10; ++c) different += differ(r, c);
  return kernel.pixel_variance * (1.0 - different / 100.0) +
         kernel.patch_variance * window_mean(1, kernel.patch_decay) +
         kernel.region_variance * window_mean(2, kernel.region_decay) +
         kernel.whole_variance * std::pow(kernel.whole_decay, different);
}

TEST(PatchCovariance, IsWhatItsDefinitionSays) {
  const PatchKernel kernel{.pixel_variance = 0.3,
                           .patch_variance = 0.8,
                           .patch_decay = 0.5,
                           .region_variance = 0.6,
                           .region_decay = 0.85,
                           .whole_variance = 0.4,
                           .whole_decay = 0.93,
                           .noise_variance = 0.01};
  const PatchCovariance covariance(kernel);
  const auto patterns = random_patterns(12, 1);
  for (const auto& a : patterns) {
    EXPECT_NEAR(covariance(quarter_rows(a), quarter_rows(a)), kernel.signal_variance(), 1e-6);
    for (const auto& b : patterns) {
      EXPECT_NEAR(covariance(quarter_rows(a), quarter_rows(b)), defined_covariance(a, b, kernel), 1e-6);
      EXPECT_EQ(covariance(quarter_rows(a), quarter_rows(b)), covariance(quarter_rows(b), quarter_rows(a)));
    }
  }
}

TEST(PatchCovariance, IsPositiveDefinite) {
  const PatchCovariance covariance(PatchKernel{});
  auto patterns = random_patterns(60, 2);
  for (int i = 0; i < 30; ++i) {  // near neighbours are the hard case
    patterns.emplace_back(patterns[0].bits() ^ (std::uint64_t{1} << i));
  }
  Eigen::MatrixXd matrix(90, 90);
  for (int i = 0; i < 90; ++i)
    for (int j = 0; j < 90; ++j) matrix(i, j) = covariance(quarter_rows(patterns[i]), quarter_rows(patterns[j]));
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues().minCoeff(), 1e-5);
}

TEST(PatchProcess, PassesThroughItsSamplesAndKnowsThatItDoes) {
  const auto patterns = random_patterns(80, 3);
  const auto values = values_of(patterns);
  PatchKernel kernel;
  kernel.noise_variance = 1e-8;
  const auto process = make_patch_process({patterns, values}, kernel);
  const auto predictions = process->predict(patterns);
  const auto means = process->means(patterns);
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    EXPECT_NEAR(predictions[i].mean, values[i], 1e-4);
    EXPECT_NEAR(means[i], predictions[i].mean, 1e-9);
    EXPECT_LT(predictions[i].deviation, 1e-3);
  }
  const pattern::Pattern far = random_patterns(1, 99).front();
  EXPECT_GT(process->predict(std::span(&far, 1)).front().deviation, 0.1);
}

TEST(PatchProcess, KnownNoiseIsTakenOutAndAPatternsOwnPartIsKept) {
  RandomStream random(6, "test");
  const auto patterns = random_patterns(200, 6);
  std::vector<double> truth = values_of(patterns), values, noise_variances;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    truth[i] += 0.1 * random.normal();  // its own
    noise_variances.push_back(i % 2 == 0 ? 0.04 : 1e-4);
    values.push_back(truth[i] + std::sqrt(noise_variances[i]) * random.normal());
  }
  const Samples samples{patterns, values, {}, {}, noise_variances};
  const auto process = make_patch_process(samples, fit_patch_kernel(samples, 1));
  const auto predictions = process->predict(patterns);
  double noisy = 0.0, noisy_believed = 0.0, sure = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    (i % 2 == 0 ? noisy : sure) += 0.01 * std::pow(predictions[i].mean - truth[i], 2);
    if (i % 2 == 0) noisy_believed += 0.01 * std::pow(predictions[i].deviation, 2);
  }
  EXPECT_LT(noisy, 0.7 * 0.04);
  EXPECT_NEAR(noisy, noisy_believed, 0.4 * noisy);
  EXPECT_LT(sure, 2e-4) << "they pass through what is known well";
  const Eigen::MatrixXd covariance = process->covariance(patterns);
  EXPECT_NEAR(covariance(3, 3), std::pow(predictions[3].deviation, 2), 1e-9);
}

TEST(PatchProcess, PredictsWhatNeighbourhoodsDecideBetterThanDistanceAloneCould) {
  const auto patterns = random_patterns(300, 4), unseen = random_patterns(200, 5);
  const auto values = values_of(patterns), truth = values_of(unseen);
  const PatchKernel kernel = fit_patch_kernel({patterns, values}, 1);
  const auto process = make_patch_process({patterns, values}, kernel);
  PatchKernel distance = kernel;  // the same variance, but patterns are only near or far as a whole
  distance.whole_variance = kernel.signal_variance() - kernel.pixel_variance;
  distance.patch_variance = distance.region_variance = 0.0;
  const double rank = rank_correlation(process->means(unseen), truth);
  EXPECT_GT(rank, 0.45);
  EXPECT_GT(rank, rank_correlation(make_patch_process({patterns, values}, distance)->means(unseen), truth) + 0.05);
  // The uncertainty is of the size of the errors.
  double squares = 0.0, believed_squares = 0.0;
  const auto predictions = process->predict(unseen);
  for (std::size_t i = 0; i < unseen.size(); ++i) {
    squares += std::pow(predictions[i].mean - truth[i], 2);
    believed_squares += std::pow(predictions[i].deviation, 2) + kernel.noise_variance;
  }
  EXPECT_GT(squares, 0.4 * believed_squares);
  EXPECT_LT(squares, 2.5 * believed_squares);
}

TEST(PatchProcess, LearnsOnlyWhatAKindredPredictorGetsWrong) {
  const auto many = random_patterns(400, 6), few = random_patterns(25, 7), unseen = random_patterns(200, 8);
  const auto known = values_of(many), truth = values_of(unseen);
  std::vector<double> other;  // another model's: scaled and shifted, and a little wrong
  for (std::size_t i = 0; i < many.size(); ++i) other.push_back(0.5 * known[i] + 1.0 + 0.05 * many[i].rigid(3, 3));
  const auto values = values_of(few);
  const std::shared_ptr<const Predictor> base = make_patch_process({many, other}, fit_patch_kernel({many, other}, 1));
  const auto with = make_patch_process({few, values}, fit_patch_kernel({few, values}, 1, base.get()), base);
  const auto without = make_patch_process({few, values}, fit_patch_kernel({few, values}, 1));
  EXPECT_GT(rank_correlation(with->means(unseen), truth), rank_correlation(without->means(unseen), truth) + 0.1);
}

/// Cost of the cheapest way down the quarter, for which only rigid pixels cost: not a sum over neighbourhoods.
double cheapest_way(const pattern::Pattern& pattern) {
  std::array<double, pattern::kQuarter> way{};
  for (int r = 0; r < pattern::kQuarter; ++r) {
    const auto above = way;
    for (int c = 0; c < pattern::kQuarter; ++c) {
      const auto at = static_cast<std::size_t>(c);
      way[at] = above[at];
      if (c > 0) way[at] = std::min(way[at], above[at - 1]);
      if (c + 1 < pattern::kQuarter) way[at] = std::min(way[at], above[at + 1]);
      if (pattern.rigid(r, c)) way[at] += 1.0 + 0.031 * r + 0.017 * c;
    }
  }
  return *std::min_element(way.begin(), way.end());
}

/// A quantity that patches see badly and a feature sees well, but for what it is of the feature.
TEST(PatchProcess, FeaturesTellWhatNeighbourhoodsDoNot) {
  const auto few = random_patterns(80, 10), unseen = random_patterns(200, 11);
  double middle = 0.0;
  for (const pattern::Pattern& pattern : few) middle += cheapest_way(pattern) / 80.0;
  const auto quantity = [&](const std::vector<pattern::Pattern>& patterns) {
    std::vector<double> values;
    for (const pattern::Pattern& pattern : patterns) values.push_back(std::pow(cheapest_way(pattern) - middle, 2));
    return values;
  };
  const Features feature = [](std::span<const pattern::Pattern> patterns) {
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(patterns.size()), 1);
    for (std::size_t i = 0; i < patterns.size(); ++i) rows(static_cast<Eigen::Index>(i), 0) = cheapest_way(patterns[i]);
    return rows;
  };
  const auto values = quantity(few);
  const auto rank_with = [&](const Features& trend, const Features& likeness) {
    const Samples samples = {few, values, trend, likeness};
    return rank_correlation(make_patch_process(samples, fit_patch_kernel(samples, 1))->means(unseen), quantity(unseen));
  };
  EXPECT_GT(rank_with({}, feature), 0.85);
  EXPECT_GT(rank_with({}, feature), rank_with({}, {}) + 0.1);
  EXPECT_GT(rank_with({}, feature), rank_with(feature, {}) + 0.1) << "no line";
}

TEST(PatchProcess, ATrendInAFeatureIsLearntFromFewSamples) {
  const auto few = random_patterns(30, 10), unseen = random_patterns(200, 11);
  const auto ways = [](std::span<const pattern::Pattern> patterns) {
    std::vector<double> values;
    for (const pattern::Pattern& pattern : patterns) values.push_back(3.0 * cheapest_way(pattern));
    return values;
  };
  const Features feature = [&](std::span<const pattern::Pattern> patterns) {
    const std::vector<double> values = ways(patterns);
    return Eigen::MatrixXd(Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
  };
  const auto values = ways(few);
  const auto rank_with = [&](const Features& trend) {
    const Samples samples = {few, values, trend};
    return rank_correlation(make_patch_process(samples, fit_patch_kernel(samples, 1))->means(unseen), ways(unseen));
  };
  EXPECT_GT(rank_with(feature), 0.99);
  EXPECT_GT(rank_with(feature), rank_with({}) + 0.03);
}

TEST(PatchProcess, CovarianceSaysWhatOneMoreSampleWouldLeave) {
  const auto patterns = random_patterns(70, 12);
  const std::vector<pattern::Pattern> learnt(patterns.begin(), patterns.begin() + 60),
      asked(patterns.begin() + 60, patterns.end());
  const std::vector<double> values = values_of(learnt);
  const PatchKernel kernel{.noise_variance = 1e-9};
  const auto process = make_patch_process({learnt, values}, kernel);
  const Eigen::MatrixXd covariance = process->covariance(asked);
  const auto predictions = process->predict(asked);
  ASSERT_EQ(covariance.rows(), 10);
  for (int i = 0; i < 10; ++i) EXPECT_NEAR(covariance(i, i), std::pow(predictions[i].deviation, 2), 1e-12);
  // The first of them becomes a sample: its column, squared, is what the others lose.
  std::vector<pattern::Pattern> more = learnt;
  more.push_back(asked.front());
  std::vector<double> more_values = values;
  more_values.push_back(0.5);
  const auto afterwards = make_patch_process({more, more_values}, kernel)->predict(asked);
  for (int i = 0; i < 10; ++i) {
    const double left = covariance(i, i) - std::pow(covariance(i, 0), 2) / covariance(0, 0);
    EXPECT_NEAR(std::pow(afterwards[i].deviation, 2), std::max(0.0, left), 1e-6) << i;
  }
}

TEST(PatchProcess, WithoutCovarianceTheLikelihoodIsThatOfIndependentNoise) {
  const auto patterns = random_patterns(25, 13);
  const std::vector<double> values = values_of(patterns);
  // Where nothing goes together the process is its prior's mean and noise: a product of normal densities.
  const double variance = 0.3;
  const PatchKernel noise{.pixel_variance = 0.0,
                          .patch_variance = 0.0,
                          .region_variance = 0.0,
                          .whole_variance = 0.0,
                          .noise_variance = variance};
  const std::vector<double> means = make_patch_process({patterns, values}, noise)->means(patterns);
  double expected = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
    expected -= 0.5 * (std::pow(values[i] - means[i], 2) / variance + std::log(2.0 * M_PI * variance));
  EXPECT_NEAR(log_likelihood({patterns, values}, noise, 1), expected, 1e-9);
}

TEST(PatchProcess, OneSampleAndEqualSamplesAreNoProblem) {
  const auto patterns = random_patterns(12, 9);
  for (const std::size_t count : {std::size_t{1}, std::size_t{12}}) {
    const std::vector<double> values(count, 2.5);
    const std::span<const pattern::Pattern> some(patterns.data(), count);
    const auto process = make_patch_process({some, values}, fit_patch_kernel({some, values}, 1));
    EXPECT_NEAR(process->means(some).front(), 2.5, 1e-3);
  }
}

}  // namespace
}  // namespace nacre::surrogate
