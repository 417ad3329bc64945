#pragma once
// Gamuts of several searches as one, and of several rounds as what each adds.

#include <span>
#include <vector>

#include "explore/search.hpp"

namespace nacre::explore {

/// Several searches as one gamut, one after the other; of a pattern that several found the first sample stays.
std::vector<Evaluated> merge_gamuts(std::span<const std::vector<Evaluated>> gamuts);

/// Samples of `now` that `base` lacks or has with another performance, in their order.
std::vector<Evaluated> changes(std::span<const Evaluated> base, std::span<const Evaluated> now);

/// `base` with `changes`: its own patterns with their new performance where they stand, further ones behind them.
std::vector<Evaluated> with_changes(std::vector<Evaluated> base, std::span<const Evaluated> changes);

}  // namespace nacre::explore
