// The extended law (material/extended_law.hpp) on packs of elements. Included after explicit_law.ipp, inside the same
// namespace; symbols as there; n = 1 - C_e^-1, so that nothing small is a difference of large numbers:
//   S = mu g ((G - 1) + n) + lambda l (1 - n),  G - 1 being what is stored.

/// Chains stretched further than this share of their limit are torn.
inline constexpr double kFilledLimit = 0.999;
/// Energy that passes every threshold.
inline constexpr double kTornEnergy = 1e30;

/// Symmetric tensors by components 11, 22, 12.
template <class Real>
struct SymmetricPack {
  Pack<Real> xx, yy, xy;
};

template <class Real>
NACRE_INLINE Pack<Real> square(Pack<Real> value) {
  return value * value;
}

/// Constants of a pack of elements.
template <class Real>
struct PackLaw {
  Pack<Real> mu, lambda, inverse_limit, flow_strain, eigenstrain, inverse_scale;
};

template <class Real>
NACRE_INLINE PackLaw<Real> load_law(const ExtendedState<Real>& s, int element) {
  const Pack<Real> none{}, one = broadcast(Real{1});
  PackLaw<Real> law{load(s.mu + element), load(s.lambda + element), none, none, none, one};
  if (s.inverse_limit) law.inverse_limit = load(s.inverse_limit + element);
  if (s.flow_strain) law.flow_strain = load(s.flow_strain + element);
  if (s.eigenstrain) {
    law.eigenstrain = load(s.eigenstrain + element);
    law.inverse_scale = one / (one + law.eigenstrain);
  }
  return law;
}

/// The elastic state of a quadrature point.
template <class Real>
struct ElasticPack {
  Pack<Real> change, log;  ///< J_e - 1, l
  SymmetricPack<Real> n;   ///< 1 - C_e^-1
  Pack<Real> half;         ///< I / 2
  SymmetricPack<Real> plastic;
};

/// Half the difference of the squares of the principal stretches.
template <class Real>
NACRE_INLINE Pack<Real> deviator(const ElasticPack<Real>& e) {
  const Pack<Real> two = broadcast(Real{2});
  return square_root(larger((e.half - e.change) * (two + e.half + e.change), Pack<Real>{}));
}

template <class Real>
NACRE_INLINE ElasticPack<Real> elastic_state(Pack<Real> a, Pack<Real> b, Pack<Real> c, Pack<Real> d) {
  ElasticPack<Real> e{};
  e.change = larger(fma(-b, c, fma(a, d, a + d)), broadcast(Real(kSmallestChange)));
  const Pack<Real> xx = fma(a, a, fma(c, c, a + a)), yy = fma(d, d, fma(b, b, d + d));
  const Pack<Real> xy = fma(a, b, fma(c, d, b + c));
  Pack<Real> inverse;
  logarithm<Real, true>(e.change, e.log, inverse);
  const Pack<Real> inverse2 = inverse * inverse, delta = fma(xx, yy, -(xy * xy));
  e.n = {(xx + delta) * inverse2, (yy + delta) * inverse2, xy * inverse2};
  e.half = broadcast(Real(0.5)) * (xx + yy);
  return e;
}

/// I / 2 with the plastic metric: + (C_e : (G - 1)) / 2. C_e = J^2 (1 - n) with its diagonal exchanged.
template <class Real>
NACRE_INLINE void add_plastic(ElasticPack<Real>& e, const SymmetricPack<Real>& g) {
  const Pack<Real> one = broadcast(Real{1}), j2 = square<Real>(one + e.change);
  const Pack<Real> cross = g.xy * e.n.xy;
  const Pack<Real> product = fma(g.xx, one - e.n.yy, fma(g.yy, one - e.n.xx, cross + cross));
  e.half = fma(broadcast(Real(0.5)) * j2, product, e.half);
  e.plastic = g;
}

/// Flow of one quadrature point: returns twice the work of flow so far. `history`: its arrays, at the element.
template <class Real, bool Commit>
NACRE_INLINE Pack<Real> flow(ElasticPack<Real>& e, const PackLaw<Real>& law, Real* const (&history)[4], int element) {
  const Pack<Real> one = broadcast(Real{1});
  add_plastic(e, {load(history[0] + element), load(history[1] + element), load(history[2] + element)});
  const Pack<Real> work = load(history[3] + element), d = deviator(e), limit = law.flow_strain;
  const auto flows = d > limit;
  const Pack<Real> ratio = flows ? limit / d : one, reached = flows ? limit : d;
  const Pack<Real> j = one + e.change, trace = square_root(fma(j, j, reached * reached)), before = one + e.half;
  const Pack<Real> kappa = fma(-ratio, before, trace), rest = ratio - one + kappa;
  const SymmetricPack<Real> g = e.plastic;
  e.plastic.xx = flows ? fma(ratio, g.xx, fma(-kappa, e.n.xx, rest)) : g.xx;
  e.plastic.yy = flows ? fma(ratio, g.yy, fma(-kappa, e.n.yy, rest)) : g.yy;
  e.plastic.xy = flows ? fma(ratio, g.xy, -(kappa * e.n.xy)) : g.xy;
  const Pack<Real> spent = law.mu * ((d - reached) * (d + reached)) / (trace + before);
  const Pack<Real> total = flows ? work + (spent + spent) : work;
  e.half = flows ? e.change + reached * reached / (trace + j) : e.half;
  if constexpr (Commit) {
    store(history[0] + element, e.plastic.xx);
    store(history[1] + element, e.plastic.yy);
    store(history[2] + element, e.plastic.xy);
    store(history[3] + element, total);
  }
  return total;
}

/// x - ln(1 + x) where x < 0, else 0.
template <class Real>
NACRE_INLINE Pack<Real> shortened(Pack<Real> x, Pack<Real> log) {
  return x < Real{0} ? x - log : Pack<Real>{};
}

/// Twice the compressive part of the energy density: of shortened principal stretches and lost area.
template <class Real>
NACRE_INLINE Pack<Real> compressive_energy(const ElasticPack<Real>& e, const PackLaw<Real>& law) {
  const Pack<Real> d = deviator(e), low = larger(e.half - d, broadcast(Real(kSmallestChange))), high = e.half + d;
  Pack<Real> log_low, unused;
  logarithm<Real, true>(low, log_low, unused);
  const Pack<Real> log_high = e.log + e.log - log_low;  // the product of the stretches is J_e
  const Pack<Real> principal = shortened<Real>(low, log_low) + shortened<Real>(high, log_high);
  return fma(law.mu, principal, e.log < Real{0} ? law.lambda * e.log * e.log : Pack<Real>{});
}

/// Adds the Maxwell branch to the stress of a point; returns twice its energy.
template <class Real, bool Commit>
NACRE_INLINE Pack<Real> relax(const ExtendedState<Real>& s, const PackLaw<Real>& law, Real* const (&history)[3],
                              int element, SymmetricPack<Real>& stress) {
  const Pack<Real> gain = broadcast(s.branch_gain), kept = broadcast(s.branch_kept);
  SymmetricPack<Real> q{};
  Pack<Real>* const parts[3] = {&q.xx, &q.yy, &q.xy};
  Pack<Real>* const total[3] = {&stress.xx, &stress.yy, &stress.xy};
  for (int i = 0; i < 3; ++i) {
    const Pack<Real> grown = gain * *total[i];
    *parts[i] = grown - load(history[i] + element);
    if constexpr (Commit) store(history[i] + element, fma(-kept, *parts[i], grown));
    *total[i] += *parts[i];
  }
  const Pack<Real> half = broadcast(Real(0.5)), trace = q.xx + q.yy, mu = law.mu;
  const Pack<Real> share = half * law.lambda / (law.lambda + mu), shear = q.xy * q.xy;
  const Pack<Real> sum = fma(q.xx, q.xx, fma(q.yy, q.yy, shear + shear)) - share * trace * trace;
  return mu > Real{0} ? half * sum / (mu * s.overstress) : Pack<Real>{};
}

/// S of one quadrature point into `stress`; returns twice the failure energy.
template <class Real, bool Commit>
NACRE_INLINE Pack<Real> second_piola(const ExtendedState<Real>& s, const PackLaw<Real>& law, ElasticPack<Real>& e,
                                     int element, int point, SymmetricPack<Real>& stress) {
  const Pack<Real> one = broadcast(Real{1});
  Pack<Real> spent{};
  SymmetricPack<Real> shear = e.n;
  if (s.flow_strain) {
    spent = flow<Real, Commit>(e, law, s.plastic[point], element);
    shear = {shear.xx + e.plastic.xx, shear.yy + e.plastic.yy, shear.xy + e.plastic.xy};
  }
  const Pack<Real> k = (e.half - e.log) + (e.half - e.log);
  Pack<Real> chains = k, mu = law.mu;
  if (s.inverse_limit) {
    const Pack<Real> filled = smaller(law.inverse_limit * k, broadcast(Real(kFilledLimit)));
    Pack<Real> log, g;
    logarithm<Real, true>(-filled, log, g);
    mu *= g;
    chains = law.inverse_limit > Real{0} ? -log / law.inverse_limit : k;
    spent = filled >= Real(kFilledLimit) ? broadcast(Real(kTornEnergy)) : spent;
  }
  const Pack<Real> pressure = law.lambda * e.log;
  stress = {fma(mu, shear.xx, pressure * (one - e.n.xx)), fma(mu, shear.yy, pressure * (one - e.n.yy)),
            fma(mu, shear.xy, -(pressure * e.n.xy))};
  Pack<Real> energy = fma(law.mu, chains, pressure * e.log) + spent;
  if (s.tension_only > Real{0}) energy -= s.tension_only * compressive_energy(e, law);
  if (s.overstress > Real{0}) energy += relax<Real, Commit>(s, law, s.branch[point], element, stress);
  return energy;
}

/// Integrity of a pack: the share of the stress left by softening.
template <class Real, bool Commit>
NACRE_INLINE Pack<Real> integrity(const ExtendedState<Real>& s, Pack<Real> energy, int element) {
  const Pack<Real> one = broadcast(Real{1}), last = broadcast(Real{1} + s.softening);
  const Pack<Real> stretch = square_root(larger(energy, Pack<Real>{}) / load(s.onset + element));
  const Pack<Real> left = stretch > Real{1} ? (last - stretch) / (stretch * s.softening) : one;
  const Pack<Real> now = larger(smaller(left, load(s.integrity + element)), Pack<Real>{});
  if constexpr (Commit) store(s.integrity + element, now);
  return now;
}

/// The extended law in the form that the sweep expects. `Commit`: whether the history advances.
template <class Number, bool Commit>
struct Extended {
  using Real = Number;
  using State = ExtendedState<Real>;

  template <class Meanwhile>
  NACRE_INLINE static EdgeForces<Real> forces(const State& s, int node, int element, const Meanwhile& meanwhile) {
    const Pack<Real> one = broadcast(Real{1});
    const Gradient<Real> g = gradient(s, node);
    const PackLaw<Real> law = load_law(s, element);
    Pack<Real> xx[2] = {}, xy[2] = {}, yx[2] = {}, yy[2] = {}, energy{};
    meanwhile();
    for (int k = 0; k < 2; ++k)
      for (int i = 0; i < 2; ++i) {
        const Pack<Real> stretched = law.inverse_scale;
        ElasticPack<Real> e = elastic_state<Real>((g.a[k] - law.eigenstrain) * stretched, g.b[i] * stretched,
                                                  g.c[k] * stretched, (g.d[i] - law.eigenstrain) * stretched);
        SymmetricPack<Real> stress;
        const Pack<Real> at_point = second_piola<Real, Commit>(s, law, e, element, 2 * k + i, stress);
        energy = s.energy ? fma(broadcast(Real(0.25)), at_point, energy) : larger(at_point, energy);
        const Pack<Real> fx = one + g.a[k], fy = one + g.d[i];
        xx[k] += fma(fx, stress.xx, g.b[i] * stress.xy);
        xy[i] += fma(fx, stress.xy, g.b[i] * stress.yy);
        yx[k] += fma(fy, stress.xy, g.c[k] * stress.xx);
        yy[i] += fma(fy, stress.yy, g.c[k] * stress.xy);
      }
    if (s.onset) {
      const Pack<Real> left = integrity<Real, Commit>(s, energy, element);
      for (int m = 0; m < 2; ++m) xx[m] *= left, xy[m] *= left, yx[m] *= left, yy[m] *= left;
    }
    if (s.energy) store(s.energy + element, energy);
    EdgeForces<Real> f;
    f.energy = energy;
    spread<Real>(xx[0], xx[1], f.bottom_x, f.top_x);
    spread<Real>(yx[0], yx[1], f.bottom_y, f.top_y);
    spread<Real>(xy[0], xy[1], f.left_x, f.right_x);
    spread<Real>(yy[0], yy[1], f.left_y, f.right_y);
    return f;
  }
};

/// The law of Eq. 2.1 with softening alone: a crack band. Few elements soften at a time, so most packs only compare.
template <class Number>
struct CrackBand {
  using Real = Number;
  using State = ExtendedState<Real>;

  template <class Meanwhile>
  NACRE_INLINE static EdgeForces<Real> forces(const State& s, int node, int element, const Meanwhile& meanwhile) {
    EdgeForces<Real> f = edge_forces<Real, false>(s, node, element, meanwhile);
    Pack<Real> left = load(s.integrity + element);
    Flags beyond;
    flag_unless_at_most(beyond, f.energy, load(s.onset + element));
    if (any(beyond)) [[unlikely]]
      left = integrity<Real, true>(s, f.energy, element);
    for (Pack<Real>* force : {&f.bottom_x, &f.top_x, &f.bottom_y, &f.top_y}) *force *= left;
    for (Pack<Real>* force : {&f.left_x, &f.right_x, &f.left_y, &f.right_y}) *force *= left;
    return f;
  }
};
