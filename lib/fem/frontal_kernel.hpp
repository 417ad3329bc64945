#pragma once
// Dense arithmetic of the frontal factorisation, compiled once per instruction set (frontal_kernel_*.cpp). Includes
// nothing that could put code of a wide instruction set into functions shared with the rest of the program.

#include <cstdint>

#include "fem/simd_level.hpp"

namespace nacre::fem {

/// Pivot and border rows of a front are padded apart to whole vectors of the widest instruction set.
inline constexpr int kFrontPadding = 8;
constexpr int padded_front_rows(int count) { return (count + kFrontPadding - 1) / kFrontPadding * kFrontPadding; }

/// A block's front, lower triangle, by columns; rows are pivots, then border, each padded by zeros.
///   name     meaning                                                       shape
///   factor   columns of the pivots, below and left of their diagonal       (pivot_rows + border_rows) x pivots
///   inverse  reciprocals of the factor's diagonal                          pivots
///   update   columns of the border, then the update of the parent front    border_rows x border
struct FrontView {
  double *factor, *inverse, *update;
  int pivots, pivot_rows, border, border_rows;
  int stride() const { return pivot_rows + border_rows; }
  /// Start of a column, such that [row] is its diagonal; only rows from there on exist.
  double* column(int row) const {
    return row < pivot_rows ? factor + row * stride() : update + (row - pivot_rows) * border_rows - pivot_rows;
  }
};

/// Consecutive unknowns of a half's border that are consecutive rows of the parent's front.
struct BorderRun {
  std::int16_t from;  ///< place in the half's border
  std::int16_t row;   ///< row of the parent's front
  std::int16_t count;
};

/// Rows of an element's eight unknowns in a front (-1 held), and its constants.
struct FrontElement {
  const std::int16_t* rows;
  double mu_pa, lambda_pa;
};

struct FrontalKernel {
  /// front += mu shear + lambda bulk; the unit matrices are 8 x 8, symmetric.
  void (*add_element)(const FrontView&, const FrontElement&, const double* shear, const double* bulk);
  /// front += the update of `half`, whose border the runs describe.
  void (*add_half)(const FrontView&, const FrontView& half, const BorderRun* runs, int count);
  /// Eliminates the pivots: L of K = L L^T in `factor`, its diagonal only as `inverse`, and K_bb - L_b L_b^T in
  /// `update`. False when a pivot is below `smallest_pivot`.
  bool (*eliminate)(const FrontView&, double smallest_pivot);
  /// x, by the front's rows: solves for the pivots, and subtracts their part from the border.
  void (*forward)(const FrontView&, double* x);
  /// x, by the front's rows: solves L^T x = b for the pivots, given the border.
  void (*backward)(const FrontView&, double* x);
};

/// The kernel for an instruction set that this processor has.
const FrontalKernel& frontal_kernel(SimdLevel level);

namespace baseline {
extern const FrontalKernel kFrontal;
}
namespace avx2 {
extern const FrontalKernel kFrontal;
}
namespace avx512 {
extern const FrontalKernel kFrontal;
}

}  // namespace nacre::fem
