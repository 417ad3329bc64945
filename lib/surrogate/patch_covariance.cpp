#include "surrogate/patch_covariance.hpp"

#include <bit>
#include <cassert>
#include <cmath>

#ifdef __clang__  // 14 leaves out a member function that it clones; instrumented builds need no speed
#define NACRE_VECTOR_CLONES
#else
#define NACRE_VECTOR_CLONES __attribute__((target_clones("default", "avx2", "avx512f"), optimize("O3")))
#endif

namespace nacre::surrogate {
namespace {

constexpr int kQuarter = pattern::kQuarter;

/// The row or column that lies at `index` when the quarter goes on as its mirror image on both sides.
constexpr int mirrored(int index) {
  if (index < 0) return -1 - index;
  return index < kQuarter ? index : 2 * kQuarter - 1 - index;
}

}  // namespace

QuarterRows quarter_rows(const pattern::Pattern& pattern) {
  QuarterRows rows{};
  for (int r = 0; r < kQuarter; ++r) {
    for (int c = 0; c < kQuarter; ++c) {
      rows[r] |= static_cast<std::uint16_t>(pattern.rigid(r, c) << c);
    }
  }
  return rows;
}

std::vector<PatchCovariance::Row> PatchCovariance::window_factors(int half_width, double decay) {
  std::vector<Row> factors(kRowValues);
  for (int row = 0; row < kRowValues; ++row) {
    for (int c = 0; c < kQuarter; ++c) {
      double factor = 1.0;
      for (int offset = -half_width; offset <= half_width; ++offset) {
        if ((row >> mirrored(c + offset)) & 1) factor *= decay;
      }
      factors[row].lanes[c] = static_cast<float>(factor);
    }
  }
  return factors;
}

PatchCovariance::PatchCovariance(const PatchKernel& kernel)
    : kernel_(kernel), patch_(window_factors(1, kernel.patch_decay)), region_(window_factors(2, kernel.region_decay)) {
  assert(kernel.patch_decay > 0.0 && kernel.patch_decay < 1.0 && kernel.region_decay > 0.0 &&
         kernel.region_decay < 1.0 && kernel.whole_decay > 0.0 && kernel.whole_decay < 1.0);
  for (int different = 0; different <= pattern::kQuarterPixels; ++different) {
    const double equal_share = 1.0 - different / static_cast<double>(pattern::kQuarterPixels);
    whole_[different] =
        kernel.pixel_variance * equal_share + kernel.whole_variance * std::pow(kernel.whole_decay, different);
  }
}

// One vector of 16 columns per row; the lanes are added in a fixed order at the end.
NACRE_VECTOR_CLONES double PatchCovariance::operator()(const QuarterRows& a, const QuarterRows& b) const {
  const Lanes *patch[kQuarter + 2], *region[kQuarter + 4];
  int different = 0;
  for (int r = -2; r < kQuarter + 2; ++r) {
    const auto row = static_cast<std::size_t>(mirrored(r));
    const std::uint16_t differences = a[row] ^ b[row];
    region[r + 2] = &region_[differences].lanes;
    if (r >= -1 && r <= kQuarter) patch[r + 1] = &patch_[differences].lanes;
    if (r >= 0 && r < kQuarter) different += std::popcount(differences);
  }
  Lanes patches = {}, regions = {};
  for (int r = 0; r < kQuarter; ++r) {
    patches += *patch[r] * *patch[r + 1] * *patch[r + 2];
    regions += (*region[r] * *region[r + 1]) * (*region[r + 2] * *region[r + 3]) * *region[r + 4];
  }
  double patch_sum = 0.0, region_sum = 0.0;
  for (int lane = 0; lane < kQuarter; ++lane) patch_sum += patches[lane], region_sum += regions[lane];
  return whole_[different] + kernel_.patch_variance * patch_sum / pattern::kQuarterPixels +
         kernel_.region_variance * region_sum / pattern::kQuarterPixels;
}

}  // namespace nacre::surrogate
