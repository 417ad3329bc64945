#include "diagnosis/signatures.hpp"

#include <algorithm>
#include <array>

#include "diagnosis/bootstrap.hpp"
#include "material/extensions.hpp"

namespace nacre::diagnosis {
namespace {

/// These sizes of an effect, and of a two-sided one their negatives, in the order of a signature's changes.
std::vector<double> signed_sizes(std::span<const double> sizes, bool one_sided) {
  std::vector<double> all(sizes.begin(), sizes.end());
  if (!one_sided)
    for (const double size : sizes) all.push_back(-size);
  return all;
}

/// Sizes of an effect that is a limit, closely spaced: a material that does not reach it does as the base, so that no
/// slope leads from there to where it begins.
std::vector<double> sizes_of_limit(std::string_view effect, std::span<const double> sizes) {
  constexpr double kStep = 1.2;
  std::vector<double> close;
  if (material::find_effect(effect)->parameters.front().strength != material::Strength::reciprocal) return close;
  for (double size = sizes.front() * kStep; size < sizes.back(); size *= kStep) close.push_back(size);
  return close;
}

/// Where the further parameters of an effect are tried beside their usual values, one at a time, at the third size and
/// its negative.
std::vector<Eigen::VectorXd> other_values(const CoordinateMap& map, const std::vector<Eigen::VectorXd>& points, int own,
                                          std::size_t sizes) {
  constexpr std::array<double, 2> kShares = {0.2, 0.8};
  constexpr std::size_t kSize = 2;
  std::vector<Eigen::VectorXd> others;
  for (std::size_t at = std::min(kSize, sizes - 1); at < points.size(); at += sizes) {
    for (int further = own + 1; further < map.size(); ++further) {
      for (const double share : kShares) {
        others.push_back(points[at]);
        others.back()[further] = map.lower(further) + share * (map.upper(further) - map.lower(further));
      }
    }
  }
  return others;
}

}  // namespace

Eigen::VectorXd usual_change(const Signature& signature, int usual, const FittedModel& anchor,
                             const Whitener& whitener) {
  Eigen::VectorXd change = signature.changes.col(usual);
  double most = signature_size(anchor, change, whitener).projected;
  for (const auto& other : signature.elsewhere.colwise()) {
    const double size = signature_size(anchor, other, whitener).projected;
    if (size > most) most = size, change = other;
  }
  return change;
}

std::vector<Signature> signatures_on(const FeatureModel& model, const FittedModel& anchor,
                                     const std::vector<std::string>& effects, std::span<const double> sizes) {
  std::vector<Signature> signatures;
  for (const std::string& effect : effects) {
    std::vector<std::string> names = anchor.effects;
    names.push_back(effect);
    const CoordinateMap map = model.map(names);
    const int own = anchor.u.size();
    Signature signature{.effect = effect, .changes = {}, .one_sided = map.lower(own) >= 0.0};
    std::vector<Eigen::VectorXd> points;
    for (const double size : signed_sizes(sizes, signature.one_sided)) {
      points.push_back(widened_start(anchor, map));
      points.back()[own] = std::clamp(size, map.lower(own), map.upper(own));
    }
    signature.changes = model.predict(map, points).colwise() - anchor.predicted;
    const std::vector<Eigen::VectorXd> others = other_values(map, points, own, sizes.size());
    if (!others.empty()) signature.elsewhere = model.predict(map, others).colwise() - anchor.predicted;
    for (const Eigen::VectorXd& other : others) signature.at_elsewhere.push_back(other.tail(map.size() - own));
    signatures.push_back(std::move(signature));
  }
  return signatures;
}

Eigen::VectorXd best_initial_guess(const FeatureModel& model, const Observations& observations,
                                   const FittedModel& anchor, const Signature& signature, const FitRules& rules) {
  std::vector<std::string> names = anchor.effects;
  names.push_back(signature.effect);
  const CoordinateMap map = model.map(names);
  const Whitener whitener(observations.covariance());
  const Eigen::Index own = anchor.u.size();
  Eigen::VectorXd best = widened_start(anchor, map);
  double least = anchor.chi2;
  const auto try_at = [&](const Eigen::VectorXd& change, const Eigen::VectorXd& effect) {
    FittedModel shifted = anchor;
    shifted.predicted += change;
    Eigen::VectorXd step;
    const double chi2 = linear_refit(shifted, observations.values, whitener, &step);
    if (chi2 >= least) return;
    least = chi2;
    best = widened_start(anchor, map);
    best.head(own) += step;
    best.tail(map.size() - own) = effect;
  };
  const std::vector<double> sizes = signed_sizes(rules.sizes, signature.one_sided);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    Eigen::VectorXd effect = widened_start(anchor, map).tail(map.size() - own);
    effect[0] = sizes[i];
    try_at(signature.changes.col(static_cast<Eigen::Index>(i)), effect);
  }
  for (std::size_t i = 0; i < signature.at_elsewhere.size(); ++i)
    try_at(signature.elsewhere.col(static_cast<Eigen::Index>(i)), signature.at_elsewhere[i]);
  std::vector<Eigen::VectorXd> points;
  for (const double size : sizes_of_limit(signature.effect, rules.sizes)) {
    points.push_back(widened_start(anchor, map));
    points.back()[own] = size;
  }
  if (!points.empty()) {
    const Eigen::MatrixXd predicted = model.predict(map, points);
    for (std::size_t i = 0; i < points.size(); ++i)
      try_at(predicted.col(static_cast<Eigen::Index>(i)) - anchor.predicted, points[i].tail(map.size() - own));
  }
  // An initial guess of exactly zero may be a stationary point of an effect that begins quadratically.
  if (best[own] == 0.0) best[own] = rules.sizes.front();
  return best;
}

}  // namespace nacre::diagnosis
