#pragma once
// The data that a time step of the extended law (material/extended_law.hpp) needs beyond ExplicitState. Null pointers
// switch a part of the law off; all arrays are rows x element_stride.
//   name           meaning                                                          numbers per element
//   eigenstrain    e                                                                1
//   inverse_limit  1 / J_m                                                          1
//   flow_strain    Y / (2 mu), infinity where nothing flows                         1
//   plastic        G - 1 by components 11, 22, 12, and twice the work of flow in    4 x 4: quadrature points 2 k + i of
//                  the unit of mu                                                   abscissa i and height k
//   branch         B = r f S - exp(-dt/tau) Q at the last step, by components       4 x 3
//   onset          2 W_f in the unit of mu, infinity if empty                       1
//   integrity      share of the stress left by softening                            1
// The threshold of an element that softens is 2 W_f (1 + v)^2, at which its stress is zero.

#include "fem/explicit_state.hpp"

namespace nacre::fem {

template <class Real>
struct ExtendedState : ExplicitState<Real> {
  Real *eigenstrain = nullptr, *inverse_limit = nullptr;
  Real *flow_strain = nullptr, *plastic[4][4] = {};
  Real* branch[4][3] = {};
  Real *onset = nullptr, *integrity = nullptr;
  Real overstress = 0;    ///< r
  Real branch_gain = 0;   ///< r f, f = (1 - exp(-dt/tau)) tau / dt, so that a stress that grows evenly is exact
  Real branch_kept = 0;   ///< exp(-dt/tau)
  Real softening = 0;     ///< v
  Real tension_only = 0;  ///< c
};

/// The kernel of the extended law for one instruction set and number type.
template <class Real>
struct ExtendedKernel {
  /// One step; advances the history of every element.
  void (*advance)(ExtendedState<Real>&);
  /// The same for softening without another law, by the arithmetic of ExplicitKernel.
  void (*advance_crack_band)(ExtendedState<Real>&);
  /// Forces on all nodes, as ExplicitKernel::internal_forces; leaves the history alone.
  void (*internal_forces)(ExtendedState<Real>&);
};

/// The kernel for an instruction set that this processor has.
template <class Real>
const ExtendedKernel<Real>& extended_kernel(SimdLevel level);

namespace baseline {
extern const ExtendedKernel<float> kExtendedSingle;
extern const ExtendedKernel<double> kExtendedDouble;
}  // namespace baseline
namespace avx2 {
extern const ExtendedKernel<float> kExtendedSingle;
extern const ExtendedKernel<double> kExtendedDouble;
}  // namespace avx2
namespace avx512 {
extern const ExtendedKernel<float> kExtendedSingle;
extern const ExtendedKernel<double> kExtendedDouble;
}  // namespace avx512

}  // namespace nacre::fem
