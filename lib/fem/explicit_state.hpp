#pragma once
// The data that one time step of the explicit solver reads and writes, and the entry points of its kernel. The
// kernel is compiled once per instruction set, so this header includes nothing that could put code of a wide
// instruction set into functions shared with the rest of the program.
//
// Units inside: lengths in elements (h), time in steps (dt). The vertical displacement is taken relative to the uniform
// stretch strain * y that the grips prescribe, so that single precision resolves the deviation and the grips' own value
// is zero.
//   name         meaning                                         shape
//   qx, qy       relative displacement of nodes, elements        (rows + 1) x stride
//   vx, vy       relative velocity, elements per step            (rows + 1) x stride
//   mu, lambda   Lame parameters x dt^2 / (4 rho h^2), 0 if empty rows x element_stride
//   threshold    2 W x dt^2 / (4 rho h^2), infinity if empty     rows x element_stride
//   energy       2 x mean energy density, in that unit; or null  rows x element_stride
// Rows of nodes are padded on both sides, rows of elements on the right, by zeros or empty elements to whole cache
// lines.

#include <cstdint>

#include "fem/simd_level.hpp"

namespace nacre::fem {

enum class Damping {
  smoothing,   ///< 3 x 3 filter of the velocities of interior nodes, Eq. 2.4 (toughness)
  exponential  ///< all velocities times exp(-gamma dt), Eq. 2.5 (modulus)
};

/// Padding of rows in numbers; every pack width divides it.
inline constexpr int kRowPadding = 16;

/// Rows of work for one element row and the node row below it; each `stride` long with `kRowPadding` zeros in front.
template <class Real>
struct ExplicitRows {
  Real *upper_x, *upper_y;    ///< force along the horizontal edges of the node row, from the element row below
  Real *below_x, *below_y;    ///< vertical edge force at the nodes from the element row below
  Real *sum_x[3], *sum_y[3];  ///< v(i-1) + v(i) + v(i+1) of three node rows, by row modulo 3
  Real* weight;               ///< alpha of Eq. 2.4 for interior columns, 0 elsewhere
};

/// Only for the energy ledger: velocities of the last step, and of one row before damping.
template <class Real>
struct ExplicitLedgerRows {
  Real *last_vx, *last_vy;
  Real *before_x, *before_y;
};

template <class Real>
struct ExplicitState {
  int columns, rows;
  int stride;          ///< numbers per row of nodes
  int element_stride;  ///< numbers per row of elements
  Real *qx, *qy, *vx, *vy;
  Real *mu, *lambda, *threshold;
  Real* energy;  ///< only for the neighbourhood criterion
  ExplicitRows<Real> row;
  ExplicitLedgerRows<Real> ledger;  ///< null without a ledger
  Damping damping;
  Real decay;        ///< exp(-gamma dt) of Eq. 2.5
  Real strain;       ///< nominal strain of the grips at this step
  double grip_step;  ///< displacement of the upper grip per step, elements; only for the ledger
  // Results of the step.
  double top_force, bottom_force;  ///< vertical reactions, in rho h^3 / dt^2 per unit thickness, tension positive
  double damping_work;   ///< sum over nodes of 2 x energy taken by damping, laboratory frame, elements^2/step^2; ledger
                         ///< only
  std::int32_t* failed;  ///< elements whose energy density passed the threshold in this step
  int failed_count;
};

/// The kernel for one instruction set and number type.
template <class Real>
struct ExplicitKernel {
  /// Forces, failure, velocities, damping, displacements: one step.
  void (*advance)(ExplicitState<Real>&);
  /// The same with damping_work accumulated.
  void (*advance_with_ledger)(ExplicitState<Real>&);
  /// The same with the mean of an element's energy density kept, in place of the largest, and compared.
  void (*advance_with_energies)(ExplicitState<Real>&);
  /// First element that is not empty and has J <= 0 or not a number at a quadrature point; -1 when there is none.
  int (*first_inverted)(const ExplicitState<Real>&);
  /// Forces of the elements on all nodes, -dW/dq, into vx and vy; the reactions. With mu and lambda of a quarter of
  /// those of the material these are per h and unit thickness.
  void (*internal_forces)(ExplicitState<Real>&);
};

/// The kernel for an instruction set that this processor has.
template <class Real>
const ExplicitKernel<Real>& explicit_kernel(SimdLevel level);

namespace baseline {
extern const ExplicitKernel<float> kSingle;
extern const ExplicitKernel<double> kDouble;
}  // namespace baseline
namespace avx2 {
extern const ExplicitKernel<float> kSingle;
extern const ExplicitKernel<double> kDouble;
}  // namespace avx2
namespace avx512 {
extern const ExplicitKernel<float> kSingle;
extern const ExplicitKernel<double> kDouble;
}  // namespace avx512

}  // namespace nacre::fem
