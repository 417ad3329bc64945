// The kernel of the explicit solver, compiled once per instruction set (explicit_kernel_*.cpp define NACRE_SIMD). The
// sweep takes the law as a template parameter: explicit_law.ipp has that of Eq. 2.1, extended_law.ipp the other one.
//
// One sweep over the rows does a whole step: element row j gives the forces on node row j, these its new velocity, and
// with the velocities of rows j-2 .. j known, row j-1 is smoothed and moved.

#include <cstdint>

#include <immintrin.h>

#include "fem/explicit_state.hpp"

namespace nacre::fem::NACRE_SIMD {

// The packs come first.
// clang-format off
#include "fem/simd_packs.hpp"
#include "fem/explicit_law.ipp"
// clang-format on

/// v(i-1) + v(i) + v(i+1), symmetric to the last bit.
template <class Real>
NACRE_INLINE Pack<Real> sum_of_three(const Real* v) {
  return (load(v - 1) + load(v + 1)) + load(v);
}

/// Row sums of velocities for the filter.
template <class Real>
void sum_row(const ExplicitState<Real>& s, int row) {
  const auto sum = [&](const Real* v, Real* out) {
    for (int i = 0; i <= s.columns; i += kLanes<Real>) store(out + i, sum_of_three(v + i));
  };
  sum(s.vx + row * s.stride, s.row.sum_x[row % 3]);
  sum(s.vy + row * s.stride, s.row.sum_y[row % 3]);
}

/// The filter's row sums around row `row`: of the row below, of itself, and of the row above, which is formed here.
template <class Real>
struct RowSums {
  const Real *below_x, *here_x, *below_y, *here_y;
  Real *above_x, *above_y;

  RowSums(const ExplicitRows<Real>& r, int row)
      : below_x(r.sum_x[(row + 2) % 3]),
        here_x(r.sum_x[row % 3]),
        below_y(r.sum_y[(row + 2) % 3]),
        here_y(r.sum_y[row % 3]),
        above_x(r.sum_x[(row + 1) % 3]),
        above_y(r.sum_y[(row + 1) % 3]) {}
};

/// Eq. 2.4 in one direction for a pack of interior nodes, then q += v.
template <class Real>
NACRE_INLINE void smooth_and_move(Real* v, Real* q, const Real* v_above, Pack<Real> weight, Pack<Real> below,
                                  Pack<Real> here, Real* above) {
  const Pack<Real> sum_above = sum_of_three(v_above);
  store(above, sum_above);
  const Pack<Real> box = (below + sum_above) + here, old = load(v);
  const Pack<Real> smooth = fma(weight, fma(broadcast(Real(1.0 / 9)), box, -old), old);
  store(v, smooth);
  store(q, load(q) + smooth);
}

/// Both directions for the pack of row `row` at `column`.
template <class Real>
NACRE_INLINE void smooth_and_move(const ExplicitState<Real>& s, const RowSums<Real>& sums, int row, int column) {
  const int at = row * s.stride + column;
  const Pack<Real> weight = load(s.row.weight + column);
  smooth_and_move(s.vx + at, s.qx + at, s.vx + at + s.stride, weight, load(sums.below_x + column),
                  load(sums.here_x + column), sums.above_x + column);
  smooth_and_move(s.vy + at, s.qy + at, s.vy + at + s.stride, weight, load(sums.below_y + column),
                  load(sums.here_y + column), sums.above_y + column);
}

template <class Real>
void smooth_and_move_row(const ExplicitState<Real>& s, int row) {
  const RowSums<Real> sums(s.row, row);
  for (int i = 0; i <= s.columns; i += kLanes<Real>) smooth_and_move(s, sums, row, i);
}

/// Lists the elements of a pack whose energy density passed the threshold.
template <class Real>
[[gnu::noinline, gnu::cold]] void list_failed(ExplicitState<Real>& s, int row, int column, const Real* energy) {
  const Real* threshold = s.threshold + row * s.element_stride + column;
  for (int lane = 0; lane < kLanes<Real> && column + lane < s.columns; ++lane)
    if (!(energy[lane] <= threshold[lane])) s.failed[s.failed_count++] = row * s.columns + column + lane;
}

/// One direction of v += f for a pack of nodes, from the forces along the horizontal and vertical edges around them,
/// those of the pack to the left included.
template <class Real>
struct NodeForces {
  Pack<Real> horizontal{}, right{};  ///< of the pack to the left

  NACRE_INLINE Pack<Real> next(Pack<Real> along, Pack<Real> left_edge, Pack<Real> right_edge, Real* below) {
    const Pack<Real> above = shifted(right, right_edge) + left_edge;
    const Pack<Real> force = (along - shifted(horizontal, along)) + (above - load(below));
    store(below, above);
    horizontal = along;
    right = right_edge;
    return force;
  }
};

/// One row of elements, and v += f for the row of nodes below it: the grip (`Grip`), which moves no node vertically, or
/// an interior one. With `Finish` also the filter and motion of the row two below, whose velocities are
/// complete.
template <class Law, bool Grip, bool Finish>
void sweep_row(typename Law::State& state, int row) {
  using Real = typename Law::Real;
  const typename Law::State s = state;  // its pointers stay in registers
  const ExplicitRows<Real>& r = s.row;
  Real *const vx = s.vx + row * s.stride, *const vy = s.vy + row * s.stride;
  const RowSums<Real> sums(r, Finish ? row - 2 : 0);
  NodeForces<Real> forces_x, forces_y;
  for (int column = 0; column < s.element_stride; column += kLanes<Real>) {
    const int element = row * s.element_stride + column;
    const auto finish_below = [&]() __attribute__((always_inline)) {
      if constexpr (Finish) smooth_and_move(s, sums, row - 2, column);
    };
    const EdgeForces<Real> f = Law::forces(s, row * s.stride + column, element, finish_below);
    Flags failed;
    flag_unless_at_most(failed, f.energy, load(s.threshold + element));
    if (any(failed)) [[unlikely]] {
      alignas(kPackBytes) Real energy[kLanes<Real>];
      store(energy, f.energy);
      list_failed(state, row, column, energy);
    }
    const Pack<Real> along_x = load(r.upper_x + column) + f.bottom_x, along_y = load(r.upper_y + column) + f.bottom_y;
    store(r.upper_x + column, f.top_x);
    store(r.upper_y + column, f.top_y);
    const Pack<Real> force_x = forces_x.next(along_x, f.left_x, f.right_x, r.below_x + column);
    const Pack<Real> force_y = forces_y.next(along_y, f.left_y, f.right_y, r.below_y + column);
    store(vx + column, load(vx + column) + force_x);
    if constexpr (!Grip) store(vy + column, load(vy + column) + force_y);
  }
}

/// The upper grip: no row of elements above it.
template <class Real, bool Held>
void top_row(ExplicitState<Real>& s) {
  const ExplicitRows<Real>& r = s.row;
  Real *const vx = s.vx + s.rows * s.stride, *const vy = s.vy + s.rows * s.stride;
  NodeForces<Real> forces_x, forces_y;
  const Pack<Real> none{};
  for (int column = 0; column < s.element_stride; column += kLanes<Real>) {
    const Pack<Real> force_x = forces_x.next(load(r.upper_x + column), none, none, r.below_x + column);
    const Pack<Real> force_y = forces_y.next(load(r.upper_y + column), none, none, r.below_y + column);
    store(vx + column, load(vx + column) + force_x);
    if constexpr (!Held) store(vy + column, load(vy + column) + force_y);
  }
}

/// v *= decay (Eq. 2.5; decay = 1 leaves a row undamped), then q += v.
template <class Real>
void decay_and_move_row(const ExplicitState<Real>& s, int row, Real decay) {
  const auto finish = [&](Real* v, Real* q) {
    for (int i = 0; i <= s.columns; i += kLanes<Real>) {
      const Pack<Real> damped = load(v + i) * decay;
      store(v + i, damped);
      store(q + i, load(q + i) + damped);
    }
  };
  finish(s.vx + row * s.stride, s.qx + row * s.stride);
  finish(s.vy + row * s.stride, s.qy + row * s.stride);
}

/// Energy that damping takes from a row whose velocities were `before`: the filter acts like a force, so its work is
/// the change of velocity times the mean of the velocities of this step and of the last one, laboratory frame. (With
/// the change of v^2 in its place the balance is off by per cents: velocities and forces live half a step apart.)
template <class Real>
double damping_work(const ExplicitState<Real>& s, int row, const Real* before_x, const Real* before_y) {
  const double stretching = s.grip_step * row / s.rows;
  const ExplicitLedgerRows<Real>& ledger = s.ledger;
  double work = 0.0;
  for (int i = 0; i <= s.columns; ++i) {
    const int at = row * s.stride + i;
    const double vx = s.vx[at], vy = s.vy[at], last_x = ledger.last_vx[at], last_y = ledger.last_vy[at];
    work += (before_x[i] - vx) * (vx + last_x) + (before_y[i] - vy) * (vy + last_y + 2.0 * stretching);
    ledger.last_vx[at] = s.vx[at];
    ledger.last_vy[at] = s.vy[at];
  }
  return work;
}

template <class Real>
void damp_and_move_row(ExplicitState<Real>& s, int row) {
  if (s.damping == Damping::exponential) {
    decay_and_move_row(s, row, s.decay);
  } else if (row == 0 || row == s.rows) {
    decay_and_move_row(s, row, Real{1});
  } else {
    smooth_and_move_row(s, row);
  }
}

template <class Real, bool Ledger>
void finish_row(ExplicitState<Real>& s, int row) {
  if constexpr (!Ledger) {
    damp_and_move_row(s, row);
  } else {
    for (int i = 0; i <= s.columns; ++i) {
      s.ledger.before_x[i] = s.vx[row * s.stride + i];
      s.ledger.before_y[i] = s.vy[row * s.stride + i];
    }
    damp_and_move_row(s, row);
    s.damping_work += damping_work(s, row, s.ledger.before_x, s.ledger.before_y);
  }
}

/// Sum of a row of vertical forces in double precision, always in the same order.
template <class Real>
double ordered_sum(const Real* values, int columns) {
  double sum = 0.0;
  for (int i = 0; i <= columns; ++i) sum += values[i];
  return sum;
}

/// Numbers too small to be normal are taken as zero while the kernel runs, and restored for the caller.
class FlushToZero {
 public:
  FlushToZero() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }
  ~FlushToZero() { _mm_setcsr(saved_); }
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

 private:
  unsigned saved_;
};

template <class Real>
void zero_row(Real* row, int columns) {
  for (int i = 0; i <= columns; i += kLanes<Real>) store(row + i, Pack<Real>{});
}

/// Before the sweep: no force comes from below the bottom row of nodes.
template <class Real>
void start_sweep(const ExplicitState<Real>& s) {
  Real* const carried[] = {s.row.upper_x, s.row.upper_y, s.row.below_x, s.row.below_y};
  for (Real* row : carried) zero_row(row, s.columns);
}

template <class Law, bool Ledger>
void advance(typename Law::State& s) {
  using Real = typename Law::Real;
  const FlushToZero flush;
  s.failed_count = 0;
  s.damping_work = 0.0;
  start_sweep(s);
  const bool fused = !Ledger && s.damping == Damping::smoothing;
  for (int row = 0; row < s.rows; ++row) {
    if (row == 0) {
      sweep_row<Law, true, false>(s, 0);
      s.bottom_force = ordered_sum(s.row.below_y, s.columns);
    } else if (fused && row > 2) {
      sweep_row<Law, false, true>(s, row);
    } else {
      sweep_row<Law, false, false>(s, row);
      if (row >= 2) finish_row<Real, Ledger>(s, row - 2);
    }
    if (row < 2) sum_row(s, row);
  }
  s.top_force = ordered_sum(s.row.below_y, s.columns);
  top_row<Real, true>(s);
  for (int row = s.rows - 2; row <= s.rows; ++row) finish_row<Real, Ledger>(s, row);
}

template <class Law>
void internal_forces(typename Law::State& s) {
  using Real = typename Law::Real;
  const FlushToZero flush;
  start_sweep(s);
  s.failed_count = 0;
  for (int row = 0; row <= s.rows; ++row) {
    zero_row(s.vx + row * s.stride, s.columns);
    zero_row(s.vy + row * s.stride, s.columns);
    if (row < s.rows) {
      sweep_row<Law, false, false>(s, row);
      if (row == 0) s.bottom_force = ordered_sum(s.row.below_y, s.columns);
    } else {
      s.top_force = ordered_sum(s.row.below_y, s.columns);
      top_row<Real, false>(s);
    }
  }
}

template <class Real>
int first_inverted(const ExplicitState<Real>& s) {
  const FlushToZero flush;
  for (int row = 0; row < s.rows; ++row) {
    for (int column = 0; column < s.element_stride; column += kLanes<Real>) {
      const Gradient<Real> g = gradient(s, row * s.stride + column);
      Flags inverted;
      for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 2; ++k)
          flag_unless_at_most(inverted, broadcast(Real(kSmallestChange)), volume_change(g, i, k));
      if (!any(inverted)) continue;
      for (int lane = 0; lane < kLanes<Real> && column + lane < s.columns; ++lane) {
        if (s.mu[row * s.element_stride + column + lane] == Real{0}) continue;
        for (int i = 0; i < 2; ++i)
          for (int k = 0; k < 2; ++k)
            if (!(volume_change(g, i, k)[lane] >= Real(kSmallestChange))) return row * s.columns + column + lane;
      }
    }
  }
  return -1;
}

}  // namespace nacre::fem::NACRE_SIMD
