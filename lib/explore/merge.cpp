#include "explore/merge.hpp"

#include <cstdint>
#include <unordered_map>
#include <unordered_set>

namespace nacre::explore {
namespace {

/// Where each pattern stands; of a repeated one the first place.
std::unordered_map<std::uint64_t, std::size_t> places_of(std::span<const Evaluated> samples) {
  std::unordered_map<std::uint64_t, std::size_t> places;
  for (std::size_t i = 0; i < samples.size(); ++i) places.emplace(samples[i].pattern.bits(), i);
  return places;
}

}  // namespace

std::vector<Evaluated> merge_gamuts(std::span<const std::vector<Evaluated>> gamuts) {
  std::vector<Evaluated> merged;
  std::unordered_set<std::uint64_t> seen;
  for (const std::vector<Evaluated>& gamut : gamuts) {
    for (const Evaluated& sample : gamut) {
      if (seen.insert(sample.pattern.bits()).second) merged.push_back(sample);
    }
  }
  return merged;
}

std::vector<Evaluated> changes(std::span<const Evaluated> base, std::span<const Evaluated> now) {
  const auto places = places_of(base);
  std::vector<Evaluated> changed;
  for (const Evaluated& sample : now) {
    const auto known = places.find(sample.pattern.bits());
    if (known == places.end() || base[known->second] != sample) changed.push_back(sample);
  }
  return changed;
}

std::vector<Evaluated> with_changes(std::vector<Evaluated> base, std::span<const Evaluated> changes) {
  const auto places = places_of(base);
  for (const Evaluated& sample : changes) {
    const auto known = places.find(sample.pattern.bits());
    if (known == places.end())
      base.push_back(sample);
    else
      base[known->second] = sample;
  }
  return base;
}

}  // namespace nacre::explore
