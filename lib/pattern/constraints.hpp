#pragma once
// Structural constraints of the design space (thesis 2.1, Figure 2-1C). They bind proposals; a pattern from elsewhere
// that violates them is still measured and simulated, with a warning.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pattern/layout.hpp"
#include "thesis/constants.hpp"

namespace nacre::pattern {

/// Rigid pixels of 400 that a proposal may have: 50 % to 85 %, both included.
inline constexpr int kMinimumRigidCount = static_cast<int>(kPixels * thesis::kMinimumRigidFraction + 0.5);
inline constexpr int kMaximumRigidCount = static_cast<int>(kPixels * thesis::kMaximumRigidFraction + 0.5);
/// From this many rigid pixels on (80 %, itself included) the corner rule covers the corner region, below it the corner
/// pixel alone. The thesis says "below 80 % ... otherwise (above 80 %)": exactly 80 % is not below, so it falls under
/// "otherwise".
inline constexpr int kCornerRegionRigidCount = static_cast<int>(kPixels * thesis::kStiffRigidFraction + 0.5);
static_assert(kMinimumRigidCount == 200 && kCornerRegionRigidCount == 320 && kMaximumRigidCount == 340);

/// Free pixels (bits of Pattern) that must be rigid in a pattern with this many rigid pixels.
std::uint64_t required_rigid_bits(int rigid_count);

/// Whether a proposal may have this pattern.
bool is_feasible(const Pattern& pattern);

/// The violated constraints, a sentence each; none when it lies in the design space.
std::vector<std::string> violations(const Pattern& pattern);

/// The first of them; nothing when it lies in the design space.
std::optional<std::string> violation(const Pattern& pattern);

/// Free pixels (bits of Pattern) that the corner rule requires to be rigid and that are soft.
std::uint64_t soft_corner_bits(const Pattern& pattern);

}  // namespace nacre::pattern
