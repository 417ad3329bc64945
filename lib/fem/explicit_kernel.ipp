// The kernel of the explicit solver, compiled once per instruction set (explicit_kernel_*.cpp define NACRE_SIMD). The
// sweep takes the law as a template parameter; extended_kernel.ipp has the other one.
//
// One sweep over the rows does a whole step: element row j gives the forces on node row j, these its new velocity, and
// with the velocities of rows j-2 .. j known, row j-1 is smoothed and moved. Symbols, per element:
//   d0, d1   difference of displacement along the bottom and top edge;  e0, e1  along the left and right edge
//   A, C     dux/dX and duy/dX at the two heights of the quadrature points;  B, D  dux/dY and duy/dY at their two
//   abscissae x = J - 1 = tr H + det H;  l = ln J;  t = (mu x + lambda l) / J
// With the law P = mu (F - F^-T) + lambda l F^-T of Eq. 2.1 this gives, free of cancellation at small strain,
//   P_xX = mu (A - D) + t (1 + D)    P_xY = mu (B + C) - t C    P_yX = mu (B + C) - t B    P_yY = mu (D - A) + t (1 +
//   A).
// Sums over quadrature points are formed so that mirroring a specimen mirrors every bit of its result.

#include <cstdint>

#include <immintrin.h>

#include "fem/explicit_state.hpp"

namespace nacre::fem::NACRE_SIMD {

#include "fem/simd_packs.hpp"

/// Abscissa of the first Gauss point on the unit interval, (1 - 1/sqrt 3) / 2.
inline constexpr double kGauss = 0.21132486540518711775;
inline constexpr double kLn2 = 0.69314718055994530942;
/// Below this J - 1 the logarithm is held: only elements that are inverted or about to fail get there.
inline constexpr double kSmallestChange = -0.9999;
/// Up to this |J - 1| the logarithm needs no reduction of its argument (1 - sqrt(1/2) = 0.293).
inline constexpr double kNearChange = 0.29;

/// Values at the two Gauss abscissae of what varies linearly between `first` and `second`; also the adjoint of that.
template <class Real>
NACRE_INLINE void spread(Pack<Real> first, Pack<Real> second, Pack<Real>& low, Pack<Real>& high) {
  const Pack<Real> rise = second - first, gauss = broadcast(static_cast<Real>(kGauss));
  low = fma(gauss, rise, first);
  high = fma(-gauss, rise, second);
}

/// The displacement gradient of a pack of elements at its quadrature points (symbols above).
template <class Real>
struct Gradient {
  Pack<Real> a[2], b[2], c[2], d[2];
};

template <class Real>
NACRE_INLINE Gradient<Real> gradient(const ExplicitState<Real>& s, int node) {
  const auto corner = [&](const Real* q, int offset) { return load(q + node + offset); };
  const int up = s.stride;
  const Pack<Real> x00 = corner(s.qx, 0), x10 = corner(s.qx, 1), x01 = corner(s.qx, up), x11 = corner(s.qx, up + 1);
  const Pack<Real> y00 = corner(s.qy, 0), y10 = corner(s.qy, 1), y01 = corner(s.qy, up), y11 = corner(s.qy, up + 1);
  const Pack<Real> strain = broadcast(s.strain);
  Gradient<Real> g;
  spread<Real>(x10 - x00, x11 - x01, g.a[0], g.a[1]);
  spread<Real>(x01 - x00, x11 - x10, g.b[0], g.b[1]);
  spread<Real>(y10 - y00, y11 - y01, g.c[0], g.c[1]);
  spread<Real>((y01 - y00) + strain, (y11 - y10) + strain, g.d[0], g.d[1]);
  return g;
}

/// J - 1 at the quadrature point of abscissa i and height k.
template <class Real>
NACRE_INLINE Pack<Real> volume_change(const Gradient<Real>& g, int i, int k) {
  return fma(-g.b[i], g.c[k], fma(g.a[k], g.d[i], g.a[k] + g.d[i]));
}

/// ln(1 + x) = k ln 2 + 2 artanh(y / (2 + y)) with 1 + y = 2^-k (1 + x) in [sqrt(1/2), sqrt 2); also 1 / (1 + x).
/// Correct to rounding near x = 0, where y = x. `Reduce` = false is for packs in which k = 0 throughout and gives the
/// same bits.
template <class Real, bool Reduce>
NACRE_INLINE void logarithm(Pack<Real> x, Pack<Real>& log, Pack<Real>& inverse) {
  using Types = PackTypes<Real>;
  const Pack<Real> one = broadcast(Real{1}), j = one + x;
  Pack<Real> y = x, exponent{};
  if constexpr (Reduce) {
    const Bits<Real> bits = (Bits<Real>)j, power = (bits - Types::kSqrtHalfBits) >> Types::kMantissaBits;
    const Pack<Real> mantissa = (Pack<Real>)(bits - (power << Types::kMantissaBits));
    y = power == 0 ? x : mantissa - one;
    exponent = __builtin_convertvector(power, Pack<Real>);
  }
  const Pack<Real> denominator = y + Real{2};
  const Pack<Real> both = one / (j * denominator);
  inverse = both * denominator;
  const Pack<Real> z = y * (both * j), z2 = z * z;
  Pack<Real> series;
  if constexpr (sizeof(Real) == 4) {
    // 2/3 + 2/5 z^2 + 2/7 z^4 + ..., interpolated at the Chebyshev points of 0 <= z^2 < 0.0295: 3e-9 of the logarithm.
    series = fma(z2, broadcast(Real(0.29579949)), broadcast(Real(0.39988781)));
    series = fma(z2, series, broadcast(Real(0.66666685)));
  } else {
    series = broadcast(Real(2.0 / 23));
    for (int n = 21; n >= 3; n -= 2) series = fma(z2, series, broadcast(Real(2.0 / n)));
  }
  log = fma(z2 * z, series, z + z);
  if constexpr (Reduce) log = fma(exponent, broadcast(Real(kLn2)), log);
}

/// t at the four quadrature points, and twice the largest energy density among them:
/// 2 W = mu ((A - D)^2 + (B + C)^2 + 2 (x - l)) + lambda l^2. Here and below 2 u is u + u: the adders have room.
template <class Real, bool Reduce>
NACRE_INLINE Pack<Real> constitutive(const Gradient<Real>& g, const Pack<Real> (&change)[2][2], Pack<Real> mu,
                                     Pack<Real> lambda, Pack<Real> (&t)[2][2]) {
  Pack<Real> largest{};
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 2; ++k) {
      const Pack<Real> x = Reduce ? larger(change[i][k], broadcast(Real(kSmallestChange))) : change[i][k];
      Pack<Real> log, inverse;
      logarithm<Real, Reduce>(x, log, inverse);
      const Pack<Real> pressure = lambda * log;
      t[i][k] = fma(mu, x, pressure) * inverse;
      const Pack<Real> difference = g.a[k] - g.d[i], shear = g.b[i] + g.c[k];
      const Pack<Real> isochoric = fma(shear, shear, difference * difference);
      const Pack<Real> rest = x - log;
      const Pack<Real> energy = fma(mu, (rest + rest) + isochoric, pressure * log);
      largest = larger(energy, largest);  // a NaN does not pass; first_inverted() finds it
    }
  }
  return largest;
}

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

/// What a pack of elements gives: energy density and the forces along its four edges.
template <class Real>
struct EdgeForces {
  Pack<Real> energy;  ///< twice the largest energy density at the quadrature points
  Pack<Real> bottom_x, top_x, bottom_y, top_y;
  Pack<Real> left_x, right_x, left_y, right_y;
};

/// `meanwhile` is work that needs nothing from here: four logarithms at a time leave half of the core idle.
template <class Real, class Meanwhile>
NACRE_INLINE EdgeForces<Real> edge_forces(const ExplicitState<Real>& s, int node, int element,
                                          const Meanwhile& meanwhile) {
  const Pack<Real> one = broadcast(Real{1});
  const Gradient<Real> g = gradient(s, node);
  const Pack<Real> mu = load(s.mu + element), lambda = load(s.lambda + element);
  Pack<Real> change[2][2], t[2][2];
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k) change[i][k] = volume_change(g, i, k);
  const Pack<Real> most = larger(larger(magnitude<Real>(change[0][0]), magnitude<Real>(change[0][1])),
                                 larger(magnitude<Real>(change[1][0]), magnitude<Real>(change[1][1])));
  Flags far;
  flag_unless_at_most(far, most, broadcast(Real(kNearChange)));
  EdgeForces<Real> f;
  meanwhile();
  f.energy = any(far) ? constitutive<Real, true>(g, change, mu, lambda, t)
                      : constitutive<Real, false>(g, change, mu, lambda, t);

  const Pack<Real> sum_a = g.a[0] + g.a[1], sum_b = g.b[0] + g.b[1], sum_c = g.c[0] + g.c[1], sum_d = g.d[0] + g.d[1];
  const Pack<Real> stretch_x[2] = {one + g.a[0], one + g.a[1]}, stretch_y[2] = {one + g.d[0], one + g.d[1]};
  Pack<Real> xx[2], xy[2], yx[2], yy[2];  // P summed over one direction of quadrature points
  for (int k = 0; k < 2; ++k) {
    xx[k] = fma(mu, (g.a[k] + g.a[k]) - sum_d, t[0][k] * stretch_y[0] + t[1][k] * stretch_y[1]);
    yx[k] = fma(mu, (g.c[k] + g.c[k]) + sum_b, -(t[0][k] * g.b[0] + t[1][k] * g.b[1]));
    xy[k] = fma(mu, (g.b[k] + g.b[k]) + sum_c, -(t[k][0] * g.c[0] + t[k][1] * g.c[1]));
    yy[k] = fma(mu, (g.d[k] + g.d[k]) - sum_a, t[k][0] * stretch_x[0] + t[k][1] * stretch_x[1]);
  }
  spread<Real>(xx[0], xx[1], f.bottom_x, f.top_x);
  spread<Real>(yx[0], yx[1], f.bottom_y, f.top_y);
  spread<Real>(xy[0], xy[1], f.left_x, f.right_x);
  spread<Real>(yy[0], yy[1], f.left_y, f.right_y);
  return f;
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

/// The law of Eq. 2.1, as the sweep asks for it: what a pack of elements gives.
template <class Number>
struct NeoHookean {
  using Real = Number;
  using State = ExplicitState<Real>;
  template <class Meanwhile>
  NACRE_INLINE static EdgeForces<Real> forces(const State& s, int node, int element, const Meanwhile& meanwhile) {
    return edge_forces(s, node, element, meanwhile);
  }
};

/// One row of elements, and v += f for the row of nodes below it: the grip (`Grip`), which moves no node vertically, or
/// an interior one. Beside it, with `Finish`, the filter and motion of the row two below, whose velocities are
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

/// Before the sweep: nothing comes from below the bottom row of nodes.
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
