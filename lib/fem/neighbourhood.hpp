#pragma once
// The neighbourhood criterion: an element fails where the mean of y = w / W over its neighbourhood reaches 1 and its
// own y is at least that mean (but for 1 %), so that a crack stays one element wide. Its length R makes fracture energy
// (some 4 R W) and strength independent of the element size, as no threshold of single elements can.
//
//   y     mean energy density of an element over its W; 0 where it is empty, has failed or lies outside the grid
//   mean  with weights (1 - |dx| / R)(1 - |dy| / R) where |dx|, |dy| < R, over the full sum of these weights

#include <vector>

#include "fem/extended_state.hpp"

namespace nacre::fem {

template <class Real>
class Neighbourhood {
 public:
  /// `radius`: R in elements, above 0; up to 1 no other element counts. Takes every W from the state's thresholds, and
  /// where the law softens puts the onset off until an element has failed by this criterion.
  Neighbourhood(double radius, ExtendedState<Real>& state);

  /// Leaves in state.failed, which has every element with y > 1, those that fail. The sums are in double precision, in
  /// an order that mirroring the grid does not change. With softening, an element that the criterion fails softens from
  /// its present energy on, and is left here once nothing of its stress is.
  void keep_failing(ExtendedState<Real>& state);

 private:
  bool fails(const ExtendedState<Real>& state, int element) const;
  double mean_around(const ExtendedState<Real>& state, int row, int column) const;
  double ratio(const ExtendedState<Real>& state, int row, int column) const;
  double row_mean(const ExtendedState<Real>& state, int row, int column) const;

  std::vector<double> weights_;          ///< of elements 0, 1, ... away along one axis; both sides sum to 1
  std::vector<Real> inverse_strengths_;  ///< 1 / (2 W) in the state's unit, 0 where empty: rows x element_stride
};

extern template class Neighbourhood<float>;
extern template class Neighbourhood<double>;

}  // namespace nacre::fem
