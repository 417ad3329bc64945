#include "families/evidence.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "base/result.hpp"
#include "base/statistics.hpp"

namespace nacre::families {
namespace {

Eigen::VectorXd centred_ranks(const std::vector<double>& values) {
  const std::vector<double> ranks = ranks_of(values);
  const Eigen::Map<const Eigen::VectorXd> vector(ranks.data(), ranks.size());
  return vector.array() - vector.mean();
}

double cosine(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const double lengths = a.norm() * b.norm();
  return lengths > 1e-9 * static_cast<double>(a.size()) ? a.dot(b) / lengths : 0.0;
}

void check(const std::vector<FeatureColumn>& features, const FeatureColumn& outcome,
           const std::vector<FeatureColumn>& controls) {
  const auto fits = [&](const FeatureColumn& column) { return column.values.size() == outcome.values.size(); };
  if (!std::ranges::all_of(features, fits) || !std::ranges::all_of(controls, fits) ||
      outcome.values.size() < controls.size() + 5)
    throw InputError::format("associations: expected columns of equal length with at least {} rows",
                             controls.size() + 5);
}

}  // namespace

std::vector<Association> associations(const std::vector<FeatureColumn>& features, const FeatureColumn& outcome,
                                      const std::vector<FeatureColumn>& controls, std::uint64_t seed,
                                      int permutations) {
  check(features, outcome, controls);
  const Eigen::Index rows = outcome.values.size();
  Eigen::MatrixXd known(rows, static_cast<Eigen::Index>(controls.size()));
  for (std::size_t k = 0; k < controls.size(); ++k)
    known.col(static_cast<Eigen::Index>(k)) = centred_ranks(controls[k].values);
  const auto remainder = [&](const std::vector<double>& values) -> Eigen::VectorXd {
    const Eigen::VectorXd ranks = centred_ranks(values);
    if (known.cols() == 0) return ranks;
    return ranks - known * known.completeOrthogonalDecomposition().solve(ranks);
  };
  std::vector<Association> result;
  std::vector<Eigen::VectorXd> remainders;
  Eigen::VectorXd left = remainder(outcome.values);
  for (const FeatureColumn& feature : features) {
    remainders.push_back(remainder(feature.values));
    result.push_back({.feature = feature.name,
                      .spearman = rank_correlation(feature.values, outcome.values),
                      .partial = cosine(remainders.back(), left)});
  }
  RandomStream random(seed, "families/evidence");
  std::vector<int> as_large(features.size(), 0);
  for (int k = 0; k < permutations; ++k) {
    for (Eigen::Index i = rows - 1; i > 0; --i) std::swap(left[i], left[random.index(static_cast<int>(i) + 1)]);
    double strongest = 0.0;
    for (const Eigen::VectorXd& feature : remainders) strongest = std::max(strongest, std::abs(cosine(feature, left)));
    for (std::size_t f = 0; f < features.size(); ++f) as_large[f] += strongest >= std::abs(result[f].partial) - 1e-12;
  }
  for (std::size_t f = 0; f < features.size(); ++f)
    result[f].p_family_wise = (1.0 + as_large[f]) / (1.0 + permutations);
  std::ranges::stable_sort(result, std::greater{}, [](const Association& a) { return std::abs(a.partial); });
  return result;
}

}  // namespace nacre::families
