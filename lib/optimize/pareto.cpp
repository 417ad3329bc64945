#include "optimize/pareto.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace nacre::optimize {
namespace {

constexpr double kPaPerGpaTimesPaPerMpa = 1e9 * 1e6;

bool finite(const Performance& point) { return std::isfinite(point.modulus_pa) && std::isfinite(point.toughness_pa); }

/// Indices by decreasing modulus, then decreasing toughness: whatever dominates a point stands before it.
std::vector<std::size_t> dominators_first(std::span<const Performance> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Performance &p = points[a], &q = points[b];
    if (p.modulus_pa != q.modulus_pa) return p.modulus_pa > q.modulus_pa;
    if (p.toughness_pa != q.toughness_pa) return p.toughness_pa > q.toughness_pa;
    return a < b;
  });
  return order;
}

/// The part of the front that encloses an area with the axes.
std::vector<Performance> positive_front(std::span<const Performance> points) {
  std::vector<Performance> front = pareto_front(points);
  std::erase_if(front, [](const Performance& point) { return point.modulus_pa <= 0.0 || point.toughness_pa <= 0.0; });
  return front;
}

}  // namespace

bool dominates(const Performance& a, const Performance& b) {
  return a.modulus_pa >= b.modulus_pa && a.toughness_pa >= b.toughness_pa && a != b;
}

std::vector<int> non_dominated_ranks(std::span<const Performance> points) {
  assert(std::all_of(points.begin(), points.end(), finite));
  // In this order a point is dominated by a member of a rank if and only if the member seen last there, which is the
  // toughest of the rank so far, is at least as tough. Those toughnesses do not increase with the rank: bisection.
  std::vector<int> ranks(points.size());
  std::vector<double> toughest;
  const std::vector<std::size_t> order = dominators_first(points);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Performance& point = points[order[i]];
    if (i > 0 && point == points[order[i - 1]]) {  // equal points do not dominate each other
      ranks[order[i]] = ranks[order[i - 1]];
      continue;
    }
    const auto rank = std::partition_point(toughest.begin(), toughest.end(),
                                           [&](double toughness) { return toughness >= point.toughness_pa; });
    ranks[order[i]] = static_cast<int>(rank - toughest.begin()) + 1;
    if (rank == toughest.end()) {
      toughest.push_back(point.toughness_pa);
    } else {
      *rank = point.toughness_pa;
    }
  }
  return ranks;
}

std::vector<double> crowding_distances(std::span<const Performance> points, std::span<const int> ranks) {
  assert(points.size() == ranks.size());
  std::vector<std::size_t> order = dominators_first(points);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ranks[a] < ranks[b]; });
  std::vector<double> distances(points.size(), 0.0);
  const auto share = [](double difference, double range) { return range > 0.0 ? difference / range : 0.0; };
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && ranks[order[end]] == ranks[order[begin]]) ++end;
    // Within a rank the moduli fall and the toughnesses rise.
    const Performance &stiffest = points[order[begin]], &toughest = points[order[end - 1]];
    const double modulus_range = stiffest.modulus_pa - toughest.modulus_pa;
    const double toughness_range = toughest.toughness_pa - stiffest.toughness_pa;
    for (std::size_t i = begin + 1; i + 1 < end; ++i) {
      const Performance &before = points[order[i - 1]], &after = points[order[i + 1]];
      distances[order[i]] = share(before.modulus_pa - after.modulus_pa, modulus_range) +
                            share(after.toughness_pa - before.toughness_pa, toughness_range);
    }
    distances[order[begin]] = distances[order[end - 1]] = std::numeric_limits<double>::infinity();
  }
  return distances;
}

std::vector<Performance> pareto_front(std::span<const Performance> points) {
  assert(std::all_of(points.begin(), points.end(), finite));
  std::vector<Performance> front;
  for (const std::size_t i : dominators_first(points)) {
    if (front.empty() || points[i].toughness_pa > front.back().toughness_pa) front.push_back(points[i]);
  }
  std::reverse(front.begin(), front.end());
  return front;
}

double hypervolume_staircase_gpa_mpa(std::span<const Performance> points) {
  double area = 0.0, previous_modulus = 0.0;
  for (const Performance& point : positive_front(points)) {
    area += (point.modulus_pa - previous_modulus) * point.toughness_pa;
    previous_modulus = point.modulus_pa;
  }
  return area / kPaPerGpaTimesPaPerMpa;
}

double hypervolume_polygon_gpa_mpa(std::span<const Performance> points) {
  const std::vector<Performance> front = positive_front(points);
  if (front.empty()) return 0.0;
  double area = front.front().modulus_pa * front.front().toughness_pa;
  for (std::size_t i = 1; i < front.size(); ++i) {
    area += (front[i].modulus_pa - front[i - 1].modulus_pa) * (front[i].toughness_pa + front[i - 1].toughness_pa) / 2.0;
  }
  return area / kPaPerGpaTimesPaPerMpa;
}

double front_gap_gpa_mpa(std::span<const Performance> a, std::span<const Performance> b) {
  const std::vector<Performance> front_a = positive_front(a), front_b = positive_front(b);
  // Between two steps both fronts are constant: the toughness of the next point to the right.
  double area = 0.0, from = 0.0;
  std::size_t i = 0, j = 0;
  while (i < front_a.size() || j < front_b.size()) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    const double next_a = i < front_a.size() ? front_a[i].modulus_pa : kNone;
    const double next_b = j < front_b.size() ? front_b[j].modulus_pa : kNone;
    const double toughness_a = i < front_a.size() ? front_a[i].toughness_pa : 0.0;
    const double toughness_b = j < front_b.size() ? front_b[j].toughness_pa : 0.0;
    const double to = std::min(next_a, next_b);
    area += (to - from) * std::abs(toughness_a - toughness_b);
    from = to;
    i += next_a == to;
    j += next_b == to;
  }
  return area / kPaPerGpaTimesPaPerMpa;
}

}  // namespace nacre::optimize
