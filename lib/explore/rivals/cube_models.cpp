#include "explore/rivals/cube_models.hpp"

#include <cmath>
#include <numeric>

#include "pattern/constraints.hpp"
#include "pattern/mutation.hpp"

namespace nacre::explore {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
constexpr int kFree = pattern::kFreePixels;

/// Up to `count` rows, chosen at random.
optimize::RegressionData part_of(const optimize::RegressionData& all, int count, RandomStream& random) {
  const auto size = static_cast<int>(all.values.size());
  if (size <= count) return all;
  std::vector<int> rows(size);
  std::iota(rows.begin(), rows.end(), 0);
  for (int i = 0; i < count; ++i) {
    std::swap(rows[i], rows[i + random.index(size - i)]);
  }
  optimize::RegressionData part{MatrixXd(count, all.inputs.cols()), VectorXd(count), VectorXd::Zero(count)};
  for (int i = 0; i < count; ++i) {
    part.inputs.row(i) = all.inputs.row(rows[i]);
    part.values[i] = all.values[rows[i]];
  }
  return part;
}

ObjectiveModel fit_objective(const MatrixXd& points, const VectorXd& values, RandomStream& random) {
  const double mean = values.mean();
  const double variance = (values.array() - mean).square().mean();
  const double deviation = variance > 0.0 ? std::sqrt(variance) : 1.0;
  const optimize::RegressionData all{points, (values.array() - mean) / deviation, VectorXd::Zero(values.size())};
  const auto kernel = optimize::fit_kernel(part_of(all, kCubeKernelSamples, random), 0, random.bits());
  return {mean, deviation, optimize::GaussianProcess(all, kernel)};
}

}  // namespace

double rigid_coordinate() { return std::sqrt(2.0 / kFree); }

VectorXd point_of(const pattern::Pattern& pattern) {
  VectorXd point(kFree);
  for (int b = 0; b < kFree; ++b) point[b] = static_cast<double>((pattern.bits() >> b) & 1u) * rigid_coordinate();
  return point;
}

MatrixXd points_of(std::span<const pattern::Pattern> patterns) {
  MatrixXd points(static_cast<Index>(patterns.size()), kFree);
  for (std::size_t i = 0; i < patterns.size(); ++i) points.row(static_cast<Index>(i)) = point_of(patterns[i]);
  return points;
}

std::vector<ObjectiveModel> fit_cube_models(std::span<const Evaluated> samples, std::uint64_t seed) {
  std::vector<pattern::Pattern> patterns;
  VectorXd modulus(static_cast<Index>(samples.size())), toughness(modulus.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    patterns.push_back(samples[i].pattern);
    modulus[i] = samples[i].performance.modulus_pa;
    toughness[i] = samples[i].performance.toughness_pa;
  }
  const MatrixXd points = points_of(patterns);
  RandomStream random(seed, "explore/cube models");
  std::vector<ObjectiveModel> models;
  models.push_back(fit_objective(points, modulus, random));
  models.push_back(fit_objective(points, toughness, random));
  return models;
}

pattern::Pattern nearest_pattern(const VectorXd& point, RandomStream& random) {
  std::uint64_t bits = 0;
  for (int b = 0; b < kFree; ++b) {
    if (point[b] > 0.5 * rigid_coordinate()) bits |= std::uint64_t{1} << b;
  }
  const pattern::Pattern rounded = pattern::flipped_if_mostly_soft(pattern::Pattern(bits));
  return pattern::is_feasible(rounded) ? rounded
                                       : pattern::mutate(rounded, pattern::MutationKind::single_pixel, random);
}

}  // namespace nacre::explore
