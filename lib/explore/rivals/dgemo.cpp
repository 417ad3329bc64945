#include "explore/rivals/dgemo.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "explore/improvement.hpp"
#include "explore/model_search.hpp"
#include "explore/rivals/cube_models.hpp"
#include "explore/rivals/family_front.hpp"
#include "explore/rivals/front_discovery.hpp"
#include "explore/surrogate_search.hpp"
#include "pattern/mutation.hpp"

namespace nacre::explore {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Negative standardised posterior means.
class PosteriorMeans final : public SmoothPair {
 public:
  explicit PosteriorMeans(const std::vector<ObjectiveModel>& models) : models_(models) {}
  Eigen::Vector2d values(const VectorXd& at) const override { return values_all(at.transpose()).row(0); }
  VectorXd gradient(int objective, const VectorXd& at) const override {
    return -models_[objective].process.mean_gradient(at);
  }
  Eigen::MatrixX2d values_all(const MatrixXd& at) const override {
    Eigen::MatrixX2d result(at.rows(), 2);
    for (int k = 0; k < 2; ++k) result.col(k) = -models_[k].process.means(at);
    return result;
  }

 private:
  const std::vector<ObjectiveModel>& models_;
};

/// A pattern near the believed front, and the family of the point that it was rounded from.
struct CandidatePattern {
  Evaluated believed;
  int family = 0;
};

/// Prices of the families in the cells: how much farther from the ideal point than the best of the cell, in fifths of
/// its distance, at most 10; 10 where the family is absent.
std::vector<std::vector<double>> family_prices(const std::vector<std::vector<FrontPoint>>& cells,
                                               const std::map<int, int>& label_of) {
  constexpr double kMost = 10.0, kUnit = 0.2;
  std::vector<std::vector<double>> prices;
  for (const auto& cell : cells) {
    std::vector<double>& row = prices.emplace_back(label_of.size(), kMost);
    for (const FrontPoint& point : cell) {
      double& price = row[label_of.at(point.family)];
      price = std::min(price, (point.values - cell.front().values).norm() / kUnit);
    }
  }
  return prices;
}

/// The points of every cell, those of the family that represents it first of all.
std::vector<FrontPoint> sparse_front(const std::vector<std::vector<FrontPoint>>& cells) {
  std::map<int, int> label_of;
  for (const auto& cell : cells) {
    for (const FrontPoint& point : cell) label_of.emplace(point.family, static_cast<int>(label_of.size()));
  }
  const FamilyAssignment assignment = assign_families(family_prices(cells, label_of), {});
  std::vector<FrontPoint> first, rest;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (FrontPoint point : cells[c]) {
      const bool stands_for_cell = label_of.at(point.family) == assignment.family[c];
      // A family of its own (-1) for what stands for no cell: it comes into a batch only at the end.
      if (!stands_for_cell) point.family = -1;
      (stands_for_cell ? first : rest).push_back(std::move(point));
    }
  }
  first.insert(first.end(), rest.begin(), rest.end());
  return first;
}

std::vector<CandidatePattern> rounded(const std::vector<FrontPoint>& points, const std::vector<ObjectiveModel>& models,
                                      const BatchRequest& batch_request, RandomStream& random) {
  std::vector<Evaluated> patterns;
  std::map<std::uint64_t, int> family_of;
  for (const FrontPoint& point : points) {
    const pattern::Pattern pattern = nearest_pattern(point.at, random);
    family_of.emplace(pattern.bits(), point.family);
    patterns.push_back({pattern, {}});
  }
  patterns = unseen(std::move(patterns), batch_request);
  std::vector<pattern::Pattern> plain;
  for (const Evaluated& each : patterns) plain.push_back(each.pattern);
  std::vector<CandidatePattern> candidates;
  if (plain.empty()) return candidates;
  const MatrixXd at = points_of(plain);
  const VectorXd modulus = models[0].process.means(at), toughness = models[1].process.means(at);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    candidates.push_back(
        {{plain[i],
          {models[0].mean + models[0].deviation * modulus[row], models[1].mean + models[1].deviation * toughness[row]}},
         family_of.at(plain[i].bits())});
  }
  return candidates;
}

/// The largest growth of every family in turn; when none is left, all families restart.
std::vector<pattern::Pattern> choose(std::vector<CandidatePattern> candidates, const BatchRequest& batch_request) {
  std::vector<Evaluated> front(batch_request.evaluated);
  std::vector<pattern::Pattern> batch;
  std::set<int> visited;
  while (static_cast<int>(batch.size()) < batch_request.count && !candidates.empty()) {
    std::vector<Evaluated> open;
    for (const CandidatePattern& each : candidates) {
      if (each.family >= 0 && !visited.contains(each.family)) open.push_back(each.believed);
    }
    if (open.empty() && !visited.empty()) {
      visited.clear();
      continue;
    }
    if (open.empty()) {
      for (const CandidatePattern& each : candidates) open.push_back(each.believed);
    }
    const pattern::Pattern best = largest_growth(open, front, 1).front();
    const auto chosen = std::find_if(candidates.begin(), candidates.end(),
                                     [&](const CandidatePattern& each) { return each.believed.pattern == best; });
    batch.push_back(best);
    front.push_back(chosen->believed);
    if (chosen->family >= 0) visited.insert(chosen->family);
    candidates.erase(chosen);
  }
  return batch;
}

}  // namespace

std::vector<pattern::Pattern> dgemo_batch(const BatchRequest& batch_request) {
  constexpr std::size_t kStart = 100;
  const std::uint64_t seed = batch_seed(batch_request);
  RandomStream random(seed, "explore/dgemo");
  const std::vector<ObjectiveModel> models = fit_cube_models(batch_request.evaluated, seed);
  std::vector<VectorXd> start;
  for (const Evaluated& best : best_by_rank(batch_request.evaluated, kStart)) start.push_back(point_of(best.pattern));
  const auto cells = discover_front(PosteriorMeans(models), start, {.edge = rigid_coordinate()}, random);
  std::vector<CandidatePattern> candidates = rounded(sparse_front(cells), models, batch_request, random);
  // Rounding may leave too few: neighbours of the best fill the batch, as far as that goes.
  for (std::size_t i = 0; static_cast<int>(candidates.size()) < batch_request.count && i < 100 * start.size(); ++i) {
    const VectorXd& near = start[i % start.size()];
    const pattern::Pattern neighbour =
        pattern::mutate(nearest_pattern(near, random), pattern::MutationKind::single_pixel, random);
    const bool is_known = std::any_of(candidates.begin(), candidates.end(),
                                      [&](const CandidatePattern& each) { return each.believed.pattern == neighbour; });
    if (!is_known && !unseen({{neighbour, {}}}, batch_request).empty()) candidates.push_back({{neighbour, {}}, -1});
  }
  return choose(std::move(candidates), batch_request);
}

}  // namespace nacre::explore
