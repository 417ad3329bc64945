#include "families/dense_sampling.hpp"

#include <limits>
#include <optional>

#include "base/result.hpp"
#include "pattern/mutation.hpp"

namespace nacre::families {

using pattern::Pattern;

NearestSeed nearest_seed(const Pattern& pattern, std::span<const Pattern> seeds) {
  NearestSeed nearest{.seed = 0, .difference = std::numeric_limits<int>::max()};
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const int difference = pattern::pixel_difference(pattern, seeds[i]);
    if (difference < nearest.difference) nearest = {i, difference};
  }
  return nearest;
}

DenseSampler::DenseSampler(std::vector<Pattern> seeds, const DenseSamplingSettings& settings)
    : settings_(settings), random_(settings.seed, "families/dense sampling") {
  for (const Pattern& seed : seeds)
    if (known_.insert(seed.bits()).second) members_.push_back(seed);
  if (members_.empty()) throw InputError("dense sampling: expected at least one seed");
  seed_count_ = members_.size();
}

std::vector<Pattern> DenseSampler::next() {
  std::vector<Pattern> found;
  for (int attempt = 0; attempt < settings_.attempts && !exhausted_; ++attempt) {
    const Pattern& parent = members_[random_.index(static_cast<int>(members_.size()))];
    const std::optional<Pattern> child =
        pattern::mutate_or_roll_back(parent, pattern::MutationKind::three_way, random_);
    if (!child || known_.contains(child->bits())) continue;
    if (nearest_seed(*child, std::span(members_).first(seed_count_)).difference > settings_.radius_pixels) continue;
    known_.insert(child->bits());
    found.push_back(*child);
    members_.push_back(*child);
    if (static_cast<int>(found.size()) == settings_.batch) return found;
  }
  exhausted_ = true;
  return found;
}

}  // namespace nacre::families
