#include "select/candidates.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <unordered_set>

namespace nacre::select {
namespace {

/// The part [from, to] of a segment's parameter in [0, 1] where a value that runs linearly from `a` to `b` is at least
/// `level`.
struct Part {
  double from = 0.0, to = 1.0;
};

Part part_at_least(double level, double a, double b) {
  constexpr Part kNone{1.0, 0.0};
  if (a >= level && b >= level) return {};
  if (a < level && b < level) return kNone;
  const double crossing = (level - a) / (b - a);
  return a >= level ? Part{0.0, crossing} : Part{crossing, 1.0};
}

bool segment_reaches(const optimize::Performance& a, const optimize::Performance& b,
                     const optimize::Performance& performance) {
  const Part modulus = part_at_least(performance.modulus_pa, a.modulus_pa, b.modulus_pa);
  const Part toughness = part_at_least(performance.toughness_pa, a.toughness_pa, b.toughness_pa);
  return std::max(modulus.from, toughness.from) <= std::min(modulus.to, toughness.to);
}

}  // namespace

bool above_polyline(const optimize::Performance& performance, std::span<const optimize::Performance> benchmark) {
  if (benchmark.size() == 1) return !segment_reaches(benchmark[0], benchmark[0], performance);
  for (std::size_t i = 1; i < benchmark.size(); ++i) {
    if (segment_reaches(benchmark[i - 1], benchmark[i], performance)) return false;
  }
  return true;
}

double stiffest_sample_toughness_pa(std::span<const explore::Evaluated> gamut) {
  assert(!gamut.empty());
  optimize::Performance stiffest = gamut.front().performance;
  for (const explore::Evaluated& sample : gamut) {
    const auto& [modulus, toughness] = sample.performance;
    if (modulus > stiffest.modulus_pa || (modulus == stiffest.modulus_pa && toughness > stiffest.toughness_pa)) {
      stiffest = sample.performance;
    }
  }
  return stiffest.toughness_pa;
}

std::vector<explore::Evaluated> candidates(std::span<const explore::Evaluated> gamut,
                                           std::span<const pattern::Pattern> measured,
                                           std::span<const optimize::Performance> benchmark, int maximum_rank) {
  if (gamut.empty()) return {};
  const std::vector<optimize::Performance> performances = explore::performances_of(gamut);
  const std::vector<int> ranks = optimize::non_dominated_ranks(performances);
  const double lowest_toughness_pa = stiffest_sample_toughness_pa(gamut);

  std::unordered_set<std::uint64_t> taken;
  for (const pattern::Pattern& pattern : measured) taken.insert(pattern.bits());
  std::vector<explore::Evaluated> chosen;
  for (std::size_t i = 0; i < gamut.size(); ++i) {
    if (ranks[i] > maximum_rank || performances[i].toughness_pa < lowest_toughness_pa) continue;
    if (!above_polyline(performances[i], benchmark)) continue;
    if (taken.insert(gamut[i].pattern.bits()).second) chosen.push_back(gamut[i]);
  }
  return chosen;
}

}  // namespace nacre::select
