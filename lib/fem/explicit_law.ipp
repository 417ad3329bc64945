// The law of Eq. 2.1 on packs of elements. Included inside a namespace that has packs (simd_packs.hpp; scalar_packs.hpp
// for one element at a time, also on a device). No include guard on purpose.
//
// Symbols, per element:
//   d0, d1   difference of displacement along the bottom and top edge;  e0, e1  along the left and right edge
//   A, C     dux/dX and duy/dX at the two heights of the quadrature points;  B, D  dux/dY and duy/dY at their two
//   abscissae x = J - 1 = tr H + det H;  l = ln J;  t = (mu x + lambda l) / J
// With the law P = mu (F - F^-T) + lambda l F^-T of Eq. 2.1 this gives, free of cancellation at small strain,
//   P_xX = mu (A - D) + t (1 + D)    P_xY = mu (B + C) - t C    P_yX = mu (B + C) - t B    P_yY = mu (D - A) + t (1 +
//   A).
// Sums over quadrature points are formed so that mirroring a specimen mirrors every bit of its result.

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
    const Bits<Real> bits = bits_of<Real>(j), power = (bits - Types::kSqrtHalfBits) >> Types::kMantissaBits;
    const Pack<Real> mantissa = pack_of<Real>(bits - (power << Types::kMantissaBits));
    y = power == 0 ? x : mantissa - one;
    exponent = converted<Real>(power);
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

/// t at the four quadrature points, and twice the largest energy density among them, or their mean:
/// 2 W = mu ((A - D)^2 + (B + C)^2 + 2 (x - l)) + lambda l^2. Here and below 2 u is u + u: the adders have room.
template <class Real, bool Reduce, bool Mean>
NACRE_INLINE Pack<Real> constitutive(const Gradient<Real>& g, const Pack<Real> (&change)[2][2], Pack<Real> mu,
                                     Pack<Real> lambda, Pack<Real> (&t)[2][2]) {
  Pack<Real> largest{}, sums[2]{};
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
      if constexpr (Mean) {
        sums[k] += energy;
      } else {
        largest = larger(energy, largest);  // a NaN does not pass; first_inverted() finds it
      }
    }
  }
  if constexpr (Mean) return broadcast(Real(0.25)) * (sums[0] + sums[1]);
  return largest;
}

/// Energy density of a pack of elements and the forces along its four edges.
template <class Real>
struct EdgeForces {
  Pack<Real> energy;  ///< twice the largest energy density at the quadrature points, or twice their mean
  Pack<Real> bottom_x, top_x, bottom_y, top_y;
  Pack<Real> left_x, right_x, left_y, right_y;
};

/// `meanwhile` is independent work: four logarithms at a time leave half of the core idle.
template <class Real, bool Mean, class Meanwhile>
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
  f.energy = any(far) ? constitutive<Real, true, Mean>(g, change, mu, lambda, t)
                      : constitutive<Real, false, Mean>(g, change, mu, lambda, t);

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

/// The law of Eq. 2.1 in the form that the sweep expects.
template <class Number>
struct NeoHookean {
  using Real = Number;
  using State = ExplicitState<Real>;
  template <class Meanwhile>
  NACRE_INLINE static EdgeForces<Real> forces(const State& s, int node, int element, const Meanwhile& meanwhile) {
    return edge_forces<Real, false>(s, node, element, meanwhile);
  }
};

/// The same for the neighbourhood criterion, which averages the energy density of elements.
template <class Number>
struct NeoHookeanMean {
  using Real = Number;
  using State = ExplicitState<Real>;
  template <class Meanwhile>
  NACRE_INLINE static EdgeForces<Real> forces(const State& s, int node, int element, const Meanwhile& meanwhile) {
    const EdgeForces<Real> f = edge_forces<Real, true>(s, node, element, meanwhile);
    store(s.energy + element, f.energy);
    return f;
  }
};
