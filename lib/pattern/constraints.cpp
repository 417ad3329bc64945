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

std::uint64_t soft_corner_bits(const Pattern& pattern) {
  return required_rigid_bits(pattern.rigid_count()) & ~pattern.bits();
}

bool is_feasible(const Pattern& pattern) {
  const int count = pattern.rigid_count();
  return count >= kMinimumRigidCount && count <= kMaximumRigidCount && soft_corner_bits(pattern) == 0;
}

std::vector<std::string> violations(const Pattern& pattern) {
  std::vector<std::string> violated;
  const int count = pattern.rigid_count();
  const double percent = 100.0 * pattern.rigid_fraction();
  if (count < kMinimumRigidCount)
    violated.push_back(fmt::format("{:.0f} % of the pixels are rigid, fewer than the 50 % required", percent));
  if (count > kMaximumRigidCount)
    violated.push_back(fmt::format("{:.0f} % of the pixels are rigid, more than the 85 % allowed", percent));
  const std::uint64_t missing = soft_corner_bits(pattern);
  if (missing == 0) return violated;
  if (count < kCornerRegionRigidCount) {
    violated.push_back("the corner pixel is soft, it must be rigid");
    return violated;
  }
  int pixels = 0;
  for (std::uint64_t rest = missing; rest != 0; rest &= rest - 1)
    pixels += Pattern::orbit_size(std::countr_zero(rest)) / 4;
  violated.push_back(fmt::format(
      "with {:.0f} % rigid pixels every pixel within {:.0f} pixels of a corner must be rigid, {} at each corner are "
      "soft",
      percent, thesis::kCornerRadius.value, pixels));
  return violated;
}

std::optional<std::string> violation(const Pattern& pattern) {
  std::vector<std::string> violated = violations(pattern);
  if (violated.empty()) return std::nullopt;
  return std::move(violated.front());
}

}  // namespace nacre::pattern
