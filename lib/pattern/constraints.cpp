#include "pattern/constraints.hpp"

#include <bit>

#include <fmt/format.h>

namespace nacre::pattern {
namespace {

constexpr std::uint64_t kCornerPixel = 1;  // free pixel 0 is pixel (0, 0)

/// Free pixels whose centre (r + 1/2, c + 1/2) lies within the corner radius of the vertex (0, 0).
std::uint64_t corner_region() {
  std::uint64_t region = 0;
  for (int r = 0; r < kQuarter; ++r) {
    for (int c = r; c < kQuarter; ++c) {
      const double y = r + 0.5, x = c + 0.5;
      if (x * x + y * y <= thesis::kCornerRadius * thesis::kCornerRadius)
        region |= std::uint64_t{1} << Pattern::free_index(r, c);
    }
  }
  return region;
}

}  // namespace

std::uint64_t required_rigid_bits(int rigid_count) {
  static const std::uint64_t region = corner_region();
  return rigid_count >= kCornerRegionRigidCount ? region : kCornerPixel;
}

bool is_feasible(const Pattern& pattern) {
  const int count = pattern.rigid_count();
  return count >= kMinimumRigidCount && count <= kMaximumRigidCount &&
         (required_rigid_bits(count) & ~pattern.bits()) == 0;
}

std::optional<std::string> violation(const Pattern& pattern) {
  const int count = pattern.rigid_count();
  const double percent = 100.0 * pattern.rigid_fraction();
  if (count < kMinimumRigidCount)
    return fmt::format("{:.0f} % of the pixels are rigid, fewer than the 50 % required", percent);
  if (count > kMaximumRigidCount)
    return fmt::format("{:.0f} % of the pixels are rigid, more than the 85 % allowed", percent);
  const std::uint64_t missing = required_rigid_bits(count) & ~pattern.bits();
  if (missing == 0) return std::nullopt;
  if (count < kCornerRegionRigidCount) return "the corner pixel is soft, it must be rigid";
  int pixels = 0;
  for (std::uint64_t rest = missing; rest != 0; rest &= rest - 1)
    pixels += Pattern::orbit_size(std::countr_zero(rest)) / 4;
  return fmt::format(
      "with {:.0f} % rigid pixels every pixel within {:.0f} pixels of a corner must be rigid, {} at each corner are "
      "soft",
      percent, thesis::kCornerRadius.value, pixels);
}

}  // namespace nacre::pattern
