#include "explore/merge.hpp"

#include <cstdint>
#include <unordered_set>

namespace nacre::explore {

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

}  // namespace nacre::explore
