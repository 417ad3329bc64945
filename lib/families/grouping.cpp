#include "families/grouping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "families/distances.hpp"
#include "thesis/constants.hpp"

namespace nacre::families {
namespace {

using DesignGroups = std::vector<std::vector<std::size_t>>;

constexpr double kLeastSilhouette = 0.25;

/// Scales the mean of all finite pairs to 1; pairs that are all zero stay. A pattern without soft pixels, infinitely
/// far from the others, is set as far as any two of them, so that it does not outweigh their differences.
void normalise(DistanceMatrix& distances) {
  const double far = largest_finite(distances);
  double sum = 0.0, pairs = 0.0;
  for (std::size_t i = 0; i < distances.count(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::isfinite(distances(i, j))) sum += distances(i, j), pairs += 1.0;
  const double factor = sum > 0.0 ? pairs / sum : 1.0;
  for (std::size_t i = 0; i < distances.count(); ++i)
    for (std::size_t j = 0; j < i; ++j) distances.set(i, j, factor * std::min(distances(i, j), far));
}

double range(std::span<const MeasuredPattern> designs, double optimize::Performance::*property) {
  const auto [low, high] =
      std::ranges::minmax(designs, {}, [&](const MeasuredPattern& m) { return m.performance.*property; });
  return std::max(high.performance.*property - low.performance.*property, 1e-300);
}

DistanceMatrix distances_between(std::span<const MeasuredPattern> designs) {
  std::vector<pattern::Pattern> patterns;
  for (const MeasuredPattern& design : designs) patterns.push_back(design.pattern);
  DistanceMatrix shape = earth_movers_distances(patterns), property(designs.size());
  const double moduli = range(designs, &optimize::Performance::modulus_pa);
  const double toughnesses = range(designs, &optimize::Performance::toughness_pa);
  for (std::size_t i = 0; i < designs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const optimize::Performance &a = designs[i].performance, &b = designs[j].performance;
      property.set(i, j,
                   std::hypot((a.modulus_pa - b.modulus_pa) / moduli, (a.toughness_pa - b.toughness_pa) / toughnesses));
    }
  normalise(shape);
  normalise(property);
  for (std::size_t i = 0; i < designs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) shape.set(i, j, shape(i, j) + property(i, j));
  return shape;
}

double mean_distance(const DistanceMatrix& distances, const std::vector<std::size_t>& a,
                     const std::vector<std::size_t>& b) {
  double sum = 0.0;
  for (const std::size_t i : a)
    for (const std::size_t j : b) sum += distances(i, j);
  return sum / static_cast<double>(a.size() * b.size());
}

/// Merges the two groups that are nearest on average.
void merge_nearest(const DistanceMatrix& distances, DesignGroups& groups) {
  std::size_t first = 0, second = 1;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < groups.size(); ++a)
    for (std::size_t b = a + 1; b < groups.size(); ++b) {
      const double distance = mean_distance(distances, groups[a], groups[b]);
      if (distance < nearest) nearest = distance, first = a, second = b;
    }
  groups[first].insert(groups[first].end(), groups[second].begin(), groups[second].end());
  groups.erase(groups.begin() + static_cast<long>(second));
}

/// Mean of (b - a) / max(a, b) over all designs, a the mean distance to one's own group, b to the nearest other one; 0
/// for a design that is alone.
double mean_silhouette(const DistanceMatrix& distances, const DesignGroups& groups) {
  double sum = 0.0;
  for (const auto& own : groups) {
    if (own.size() < 2) continue;
    for (const std::size_t i : own) {
      const double size = static_cast<double>(own.size());
      const double a = mean_distance(distances, {i}, own) * size / (size - 1.0);  // its zero to itself left out
      double b = std::numeric_limits<double>::infinity();
      for (const auto& other : groups)
        if (&other != &own) b = std::min(b, mean_distance(distances, {i}, other));
      if (std::max(a, b) > 0.0) sum += (b - a) / std::max(a, b);
    }
  }
  return sum / static_cast<double>(distances.count());
}

std::vector<SeedFamily> named(std::span<const MeasuredPattern> designs, DesignGroups groups) {
  const auto stiffest = [&](const std::vector<std::size_t>& group) {
    double modulus = 0.0;
    for (const std::size_t i : group) modulus = std::max(modulus, designs[i].performance.modulus_pa);
    return modulus;
  };
  std::ranges::stable_sort(groups, std::greater{}, stiffest);
  std::vector<SeedFamily> families;
  for (std::vector<std::size_t>& group : groups) {
    std::ranges::sort(group);
    SeedFamily family{.name = "family-" + std::to_string(families.size() + 1), .seeds = {}};
    for (const std::size_t i : group) family.seeds.push_back(designs[i].pattern);
    families.push_back(std::move(family));
  }
  return families;
}

}  // namespace

double calibration_weight(const SeedFamily& family, const pattern::Pattern& measured) {
  constexpr double kSeedWeight = 1.0, kOthersWeight = thesis::kOtherFamilyWeight;
  return std::ranges::count(family.seeds, measured) > 0 ? kSeedWeight : kOthersWeight;
}

std::vector<MeasuredPattern> near_pareto(std::span<const MeasuredPattern> measured, int maximum_rank) {
  std::vector<optimize::Performance> performances;
  for (const MeasuredPattern& member : measured) performances.push_back(member.performance);
  const std::vector<int> ranks = optimize::non_dominated_ranks(performances);
  std::vector<MeasuredPattern> near;
  for (std::size_t i = 0; i < measured.size(); ++i)
    if (ranks[i] <= maximum_rank) near.push_back(measured[i]);
  return near;
}

std::vector<SeedFamily> proposed_families(std::span<const MeasuredPattern> designs, int largest_count) {
  if (designs.empty()) return {};
  const DistanceMatrix distances = distances_between(designs);
  DesignGroups groups(designs.size());
  for (std::size_t i = 0; i < groups.size(); ++i) groups[i] = {i};
  DesignGroups best;
  double best_silhouette = kLeastSilhouette;
  while (groups.size() > 1) {
    const bool countable = static_cast<int>(groups.size()) <= largest_count && groups.size() < designs.size();
    const double silhouette = countable ? mean_silhouette(distances, groups) : 0.0;
    if (silhouette > best_silhouette) best_silhouette = silhouette, best = groups;
    merge_nearest(distances, groups);
  }
  return named(designs, best.empty() ? groups : best);
}

}  // namespace nacre::families
