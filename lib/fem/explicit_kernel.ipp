// The kernel of the explicit solver, compiled once per instruction set (explicit_kernel_*.cpp define NACRE_SIMD).
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
/// 2 W = mu ((A - D)^2 + (B + C)^2 + 2 (x - l)) + lambda l^2.
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
      const Pack<Real> energy = fma(mu, fma(broadcast(Real{2}), x - log, isochoric), pressure * log);
      largest = larger(energy, largest);  // a NaN does not pass; first_inverted() finds it
    }
  }
  return largest;
}

/// Edge forces of one row of elements; true when some element passed its threshold.
template <class Real>
bool element_row(const ExplicitState<Real>& s, int row) {
  const ExplicitRows<Real>& r = s.row;
  const Real *mu_row = s.mu + row * s.element_stride, *lambda_row = s.lambda + row * s.element_stride;
  const Real* threshold_row = s.threshold + row * s.element_stride;
  const Pack<Real> one = broadcast(Real{1}), two = broadcast(Real{2});
  Flags flags;
  for (int column = 0; column < s.element_stride; column += kLanes<Real>) {
    const Gradient<Real> g = gradient(s, row * s.stride + column);
    const Pack<Real> mu = load(mu_row + column), lambda = load(lambda_row + column);
    Pack<Real> change[2][2], t[2][2];
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < 2; ++k) change[i][k] = volume_change(g, i, k);
    const Pack<Real> most = larger(larger(magnitude<Real>(change[0][0]), magnitude<Real>(change[0][1])),
                                   larger(magnitude<Real>(change[1][0]), magnitude<Real>(change[1][1])));
    Flags far;
    flag_unless_at_most(far, most, broadcast(Real(kNearChange)));
    const Pack<Real> energy = any(far) ? constitutive<Real, true>(g, change, mu, lambda, t)
                                       : constitutive<Real, false>(g, change, mu, lambda, t);
    store(r.excess + column, energy);
    flag_unless_at_most(flags, energy, load(threshold_row + column));

    const Pack<Real> sum_a = g.a[0] + g.a[1], sum_b = g.b[0] + g.b[1], sum_c = g.c[0] + g.c[1], sum_d = g.d[0] + g.d[1];
    const Pack<Real> stretch_x[2] = {one + g.a[0], one + g.a[1]}, stretch_y[2] = {one + g.d[0], one + g.d[1]};
    Pack<Real> xx[2], xy[2], yx[2], yy[2];  // P summed over one direction of quadrature points
    for (int k = 0; k < 2; ++k) {
      xx[k] = fma(mu, fma(two, g.a[k], -sum_d), t[0][k] * stretch_y[0] + t[1][k] * stretch_y[1]);
      yx[k] = fma(mu, fma(two, g.c[k], sum_b), -(t[0][k] * g.b[0] + t[1][k] * g.b[1]));
      xy[k] = fma(mu, fma(two, g.b[k], sum_c), -(t[k][0] * g.c[0] + t[k][1] * g.c[1]));
      yy[k] = fma(mu, fma(two, g.d[k], -sum_a), t[k][0] * stretch_x[0] + t[k][1] * stretch_x[1]);
    }
    Pack<Real> low, high;
    spread<Real>(xx[0], xx[1], low, high);
    store(r.horizontal_x + column, load(r.upper_x + column) + low);
    store(r.upper_x + column, high);
    spread<Real>(yx[0], yx[1], low, high);
    store(r.horizontal_y + column, load(r.upper_y + column) + low);
    store(r.upper_y + column, high);
    spread<Real>(xy[0], xy[1], low, high);
    store(r.left_x + column, low);
    store(r.right_x + column, high);
    spread<Real>(yy[0], yy[1], low, high);
    store(r.left_y + column, low);
    store(r.right_y + column, high);
  }
  return any(flags);
}

/// Lists the elements of a row whose energy density passed the threshold.
template <class Real>
void list_failed(ExplicitState<Real>& s, int row) {
  const Real* threshold_row = s.threshold + row * s.element_stride;
  for (int column = 0; column < s.columns; ++column)
    if (!(s.row.excess[column] <= threshold_row[column])) s.failed[s.failed_count++] = row * s.columns + column;
}

/// v += f for one row of nodes from the edge forces around it. Grips move no node vertically: `Grip` leaves vy alone.
template <class Real, bool Grip>
void accelerate_row(const ExplicitState<Real>& s, int row) {
  const ExplicitRows<Real>& r = s.row;
  Real *vx = s.vx + row * s.stride, *vy = s.vy + row * s.stride;
  for (int i = 0; i <= s.columns; i += kLanes<Real>) {
    const Pack<Real> above_x = load(r.right_x + i - 1) + load(r.left_x + i);
    const Pack<Real> above_y = load(r.right_y + i - 1) + load(r.left_y + i);
    const Pack<Real> horizontal_x = load(r.horizontal_x + i) - load(r.horizontal_x + i - 1);
    store(vx + i, load(vx + i) + (horizontal_x + (above_x - load(r.below_x + i))));
    if constexpr (!Grip) {
      const Pack<Real> horizontal_y = load(r.horizontal_y + i) - load(r.horizontal_y + i - 1);
      store(vy + i, load(vy + i) + (horizontal_y + (above_y - load(r.below_y + i))));
    }
    store(r.below_x + i, above_x);
    store(r.below_y + i, above_y);
  }
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

/// Eq. 2.4 for one interior row, then q += v. Forms the sums of the row above, which has just been accelerated.
template <class Real>
void smooth_and_move_row(const ExplicitState<Real>& s, int row) {
  const Pack<Real> ninth = broadcast(Real(1.0 / 9));
  const auto finish = [&](Real* v, Real* q, Real* const(&sums)[3]) {
    const Real *below = sums[(row + 2) % 3], *here = sums[row % 3];
    Real* above = sums[(row + 1) % 3];
    for (int i = 0; i <= s.columns; i += kLanes<Real>) {
      const Pack<Real> sum_above = sum_of_three(v + s.stride + i);
      store(above + i, sum_above);
      const Pack<Real> box = (load(below + i) + sum_above) + load(here + i), old = load(v + i);
      const Pack<Real> smooth = fma(load(s.row.weight + i), fma(ninth, box, -old), old);
      store(v + i, smooth);
      store(q + i, load(q + i) + smooth);
    }
  };
  finish(s.vx + row * s.stride, s.qx + row * s.stride, s.row.sum_x);
  finish(s.vy + row * s.stride, s.qy + row * s.stride, s.row.sum_y);
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

/// After the last row of elements: none stands above the top row of nodes.
template <class Real>
void end_sweep(const ExplicitState<Real>& s) {
  const ExplicitRows<Real>& r = s.row;
  Real* const above[] = {r.left_x, r.right_x, r.left_y, r.right_y};
  for (Real* row : above) zero_row(row, s.columns);
  for (int i = 0; i <= s.columns; i += kLanes<Real>) {
    store(r.horizontal_x + i, load(r.upper_x + i));
    store(r.horizontal_y + i, load(r.upper_y + i));
  }
}

template <class Real, bool Ledger>
void advance(ExplicitState<Real>& s) {
  const FlushToZero flush;
  s.failed_count = 0;
  s.damping_work = 0.0;
  start_sweep(s);
  for (int row = 0; row < s.rows; ++row) {
    if (element_row(s, row)) list_failed(s, row);
    if (row == 0) {
      accelerate_row<Real, true>(s, 0);
      s.bottom_force = ordered_sum(s.row.below_y, s.columns);
    } else {
      accelerate_row<Real, false>(s, row);
    }
    if (row < 2) sum_row(s, row);
    if (row > 0) finish_row<Real, Ledger>(s, row - 1);
  }
  s.top_force = ordered_sum(s.row.below_y, s.columns);
  end_sweep(s);
  accelerate_row<Real, true>(s, s.rows);
  finish_row<Real, Ledger>(s, s.rows - 1);
  finish_row<Real, Ledger>(s, s.rows);
}

template <class Real>
void internal_forces(ExplicitState<Real>& s) {
  const FlushToZero flush;
  start_sweep(s);
  for (int row = 0; row <= s.rows; ++row) {
    zero_row(s.vx + row * s.stride, s.columns);
    zero_row(s.vy + row * s.stride, s.columns);
    if (row < s.rows) {
      element_row(s, row);
    } else {
      s.top_force = ordered_sum(s.row.below_y, s.columns);
      end_sweep(s);
    }
    accelerate_row<Real, false>(s, row);
    if (row == 0) s.bottom_force = ordered_sum(s.row.below_y, s.columns);
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

extern const ExplicitKernel<float> kSingle = {advance<float, false>, advance<float, true>, first_inverted<float>, internal_forces<float>};
extern const ExplicitKernel<double> kDouble = {advance<double, false>, advance<double, true>, first_inverted<double>,
                                               internal_forces<double>};

}  // namespace nacre::fem::NACRE_SIMD
