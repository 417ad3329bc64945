#include "crack/crack_record.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "crack/distances.hpp"
#include "crack/marks.hpp"
#include "tester/fracture_test.hpp"

namespace nacre::crack {
namespace {

/// Of equally long paths the one that failed first is taken. Far below the difference of any two lengths.
constexpr double kLatenessCost = 1e-6;

/// State of every element after the test.
struct FailureField {
  const fem::Grid& grid;
  std::vector<double> lateness;  ///< 0..1 in the order of failing; below 0 where nothing failed
  bool failed(int element) const { return lateness[element] >= 0.0; }
  bool empty(int element) const { return grid.phase[element] == fem::Phase::empty; }
  int column(int element) const { return element % grid.columns; }
};

FailureField field_of(const fem::Grid& grid, const std::vector<tester::Break>& order) {
  FailureField field{grid, std::vector<double>(grid.element_count(), -1.0)};
  const double last = order.empty() ? 0.0 : order.back().strain;
  for (const tester::Break& broken : order) {
    assert(broken.element >= 0 && broken.element < grid.element_count() && !field.empty(broken.element));
    // By strain, not by place in the list: elements of one step failed together.
    field.lateness[broken.element] = last > 0.0 ? broken.strain / last : 0.0;
  }
  return field;
}

/// Start of the path: the notch, or without one the failed elements farthest left.
std::vector<int> origins(const FailureField& field, const std::vector<tester::Break>& order) {
  std::vector<int> elements;
  for (int e = 0; e < field.grid.element_count(); ++e)
    if (field.empty(e)) elements.push_back(e);
  if (!elements.empty()) return elements;
  int left = field.grid.columns;
  for (const tester::Break& broken : order) left = std::min(left, field.column(broken.element));
  for (const tester::Break& broken : order)
    if (field.column(broken.element) == left) elements.push_back(broken.element);
  return elements;
}

/// The shortest path from `from` to the failed element farthest right, without the elements of the notch.
std::vector<int> cheapest_way(const FailureField& field, const std::vector<int>& from,
                              const std::vector<tester::Break>& order) {
  const auto cost = [&](int e) {
    if (field.empty(e)) return 1.0;
    return field.failed(e) ? 1.0 + kLatenessCost * field.lateness[e] : kIntactCost;
  };
  int right = 0;
  for (const tester::Break& broken : order) right = std::max(right, field.column(broken.element));
  const auto arrived = [&](int e) { return field.failed(e) && field.column(e) == right; };
  const Distances distances = distances_from(field.grid, from, cost, arrived);
  std::vector<int> way;
  for (int e = *distances.arrived; e >= 0 && !field.empty(e); e = distances.previous[e]) way.push_back(e);
  std::reverse(way.begin(), way.end());
  return way;
}

CrackPath measured(const FailureField& field, std::vector<int> way) {
  const fem::Grid& grid = field.grid;
  CrackPath path;
  double failed_length = 0.0, length = 0.0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    // An element's share of the length: half of either step, half an element at the ends.
    const double before = i == 0 ? 1.0 : step_length(grid, way[i - 1], way[i]);
    const double after = i + 1 == way.size() ? 1.0 : step_length(grid, way[i], way[i + 1]);
    const double share = 0.5 * (before + after);
    length += share;
    if (!field.failed(way[i])) continue;
    failed_length += share;
    path.material[static_cast<std::size_t>(grid.phase[way[i]])] += share;
  }
  for (double& share : path.material) share /= failed_length;
  const auto [left, right] = std::minmax({field.column(way.front()), field.column(way.back())});
  path.length_m = length * grid.element_size_m;
  path.straight_length_m = (right - left + 1) * grid.element_size_m;
  path.bridged_share = 1.0 - failed_length / length;
  path.crosses = field.column(way.back()) == grid.columns - 1;
  path.elements = std::move(way);
  return path;
}

/// The longest branches are removed one after the other: each begins where the cracks are farthest from everything
/// removed so far. Also gives the failed elements that the path's crack does not reach.
std::vector<int> tips_of_branches(const FailureField& field, const std::vector<int>& path,
                                  const std::vector<tester::Break>& order, std::vector<int>& unreached) {
  const double shortest = kShortestBranchElements;
  const auto cost = [&](int e) { return field.failed(e) ? 1.0 : kImpassable; };
  std::vector<int> taken;
  for (const int e : path)
    if (field.failed(e)) taken.push_back(e);
  Distances distances = distances_from(field.grid, taken, cost);
  for (const tester::Break& broken : order)
    if (!std::isfinite(distances.cost[broken.element])) unreached.push_back(broken.element);
  std::vector<int> tips;
  while (true) {
    int tip = -1;
    double farthest = shortest;
    for (const tester::Break& broken : order) {
      const double distance = distances.cost[broken.element];
      if (!std::isfinite(distance) || distance < farthest || (distance == farthest && tip >= 0)) continue;
      farthest = distance;
      tip = broken.element;
    }
    if (tip < 0) return tips;
    tips.push_back(tip);
    std::vector<int> branch;
    for (int e = tip; e >= 0; e = distances.previous[e]) branch.push_back(e);
    shorten(field.grid, branch, cost, distances);
  }
}

int count_groups(const FailureField& field, std::vector<int> elements) {
  const auto cost = [&](int e) { return field.failed(e) ? 1.0 : kImpassable; };
  int groups = 0;
  while (!elements.empty()) {
    const Distances distances = distances_from(field.grid, {elements.front()}, cost);
    const auto rest =
        std::partition(elements.begin(), elements.end(), [&](int e) { return std::isfinite(distances.cost[e]); });
    if (rest - elements.begin() >= kSmallestCrackElements) ++groups;
    elements.erase(elements.begin(), rest);
  }
  return groups;
}

}  // namespace

CrackRecord crack_record(const fem::Grid& notched, std::vector<tester::Break> order) {
  CrackRecord record;
  record.columns = notched.columns;
  record.rows = notched.rows;
  record.order = std::move(order);
  if (record.order.empty()) return record;
  const FailureField field = field_of(notched, record.order);
  record.path = measured(field, cheapest_way(field, origins(field, record.order), record.order));
  std::vector<int> unreached;
  record.branches = tips_of_branches(field, record.path->elements, record.order, unreached).size();
  record.separate_cracks = count_groups(field, unreached);
  return record;
}

std::vector<int> branch_tips(const fem::Grid& notched, const CrackRecord& record) {
  if (!record.path) return {};
  std::vector<int> unreached;
  return tips_of_branches(field_of(notched, record.order), record.path->elements, record.order, unreached);
}

CrackRecord record_of(const tester::Simulation& simulation, std::vector<tester::Break> order) {
  return crack_record(tester::fracture_test(simulation).grid, std::move(order));
}

}  // namespace nacre::crack
