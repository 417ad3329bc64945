#pragma once
// Covariance of two patterns for a quantity that depends on local structure, as fracture does: neighbourhood by
// neighbourhood, at the same places.

#include <array>
#include <cstdint>
#include <vector>

#include "pattern/layout.hpp"

namespace nacre::surrogate {

/// The upper-left quarter, row by row: bit c of rows[r] is pixel (r, c).
using QuarterRows = std::array<std::uint16_t, pattern::kQuarter>;
QuarterRows quarter_rows(const pattern::Pattern& pattern);

/// Weights and decays of the covariance. A decay is the factor that every pixel in which two neighbourhoods differ
/// costs. Of features, which patch_process.hpp adds, a length is how far apart patterns may be in them.
struct PatchKernel {
  double pixel_variance = 0.25;  ///< single pixels: the share of equal ones
  double patch_variance = 1.0;   ///< 3 x 3 neighbourhoods
  double patch_decay = 0.6;      ///< in (0, 1)
  double region_variance = 0.5;  ///< 5 x 5 neighbourhoods
  double region_decay = 0.8;     ///< in (0, 1)
  double whole_variance = 0.25;  ///< the quarter as a whole
  double whole_decay = 0.95;     ///< in (0, 1), per pixel of the quarter
  double feature_variance = 0.0;
  double feature_length = 1.0;   ///< root mean square over the features
  double noise_variance = 0.01;  ///< the part that neighbourhoods cannot explain: of a pattern with itself only
  double signal_variance() const {
    return pixel_variance + patch_variance + region_variance + whole_variance + feature_variance;
  }
};

/// k(x, x') = v_1 s + v_3 mean_p d_3^h3(p) + v_5 mean_p d_5^h5(p) + v_w d_w^h: s the share of equal pixels of the
/// quarter, h the number of different ones, h3(p) and h5(p) those in the 3 x 3 and 5 x 5 neighbourhood of pixel p,
/// where the pattern goes on as its mirror image. Each term is a product of correlations, or a mean of such: positive
/// definite. The terms see interactions of pixels up to their own size, so that little data suffices for what is local.
/// Equal bits on every instruction set (fixed lanes, no contraction).
class PatchCovariance {
 public:
  explicit PatchCovariance(const PatchKernel& kernel);
  double operator()(const QuarterRows& a, const QuarterRows& b) const;

 private:
  static constexpr int kLanes = 16;  ///< columns of the quarter, filled up with zeros
  static constexpr int kRowValues = 1 << pattern::kQuarter;
  /// A vector by name: left to themselves, compilers take loops over its lanes apart.
  using Lanes __attribute__((vector_size(kLanes * sizeof(float)))) = float;
  struct alignas(sizeof(Lanes)) Row {
    Lanes lanes;
  };
  /// Factors of one row of differences for the windows around each column.
  static std::vector<Row> window_factors(int half_width, double decay);

  PatchKernel kernel_;
  std::vector<Row> patch_, region_;
  std::array<double, pattern::kQuarter * pattern::kQuarter + 1> whole_{};  ///< by the number of different pixels
};

}  // namespace nacre::surrogate
