#include "laboratory/hidden_coupon.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nacre::laboratory {
namespace {

/// What a power of the rate, or two relaxation times, leave of stresses that a coupon bore: the integral of their
/// relaxation function over the past, in closed form for stresses that grew evenly over each step.
class PastStresses {
 public:
  PastStresses(const Truth& truth, double rigid_fraction) : effects_(truth.effects) {
    if (effects_.rate_exponent == 0.0) return;
    constexpr double kUsualRate = 6.17e-4, kFirst = 0.0005, kLast = 0.0025;
    Truth of_powers = truth;
    of_powers.effects = {.rate_exponent = effects_.rate_exponent, .rate_exponent_ratio = effects_.rate_exponent_ratio};
    const auto modulus = [&](double rate_per_s) {
      return homogeneous_modulus(of_powers, rigid_fraction, {.strain_rate_per_s = rate_per_s});
    };
    exponent_ = std::log(modulus(10.0 * kUsualRate) / modulus(kUsualRate)) / std::log(10.0);
    const double rest = 1.0 - exponent_, usual_s = 1.0 / kUsualRate;
    factor_ = (kLast - kFirst) * usual_s / (std::pow(kLast * usual_s, rest) - std::pow(kFirst * usual_s, rest));
  }
  bool any() const { return exponent_ > 0.0 || effects_.two_overstresses > 0.0; }
  /// A step that takes `dt_s`, to this stress.
  void add(double stress_pa, double dt_s) {
    steps_.push_back({now_s_, now_s_ + dt_s, stress_pa - last_pa_});
    now_s_ += dt_s;
    last_pa_ = stress_pa;
  }
  /// What is left of all.
  double left_pa() const {
    double sum = 0.0;
    for (const Step& step : steps_)
      if (step.change_pa != 0.0)
        sum += step.change_pa * (integral(now_s_ - step.from_s) - integral(now_s_ - step.to_s)) /
               (step.to_s - step.from_s);
    return sum;
  }

 private:
  struct Step {
    double from_s, to_s, change_pa;
  };
  /// Of the relaxation function, up to this age.
  double integral(double age_s) const {
    if (exponent_ > 0.0) return factor_ * std::pow(age_s, 1.0 - exponent_);
    const double shorter_s = effects_.shorter_relaxation_s, longer_s = kLongerRelaxation * shorter_s;
    return age_s - effects_.two_overstresses *
                       (shorter_s * std::expm1(-age_s / shorter_s) + longer_s * std::expm1(-age_s / longer_s));
  }

  HiddenEffects effects_;
  double exponent_ = 0.0, factor_ = 1.0, now_s_ = 0.0, last_pa_ = 0.0;
  std::vector<Step> steps_;
};

/// Uniaxial response by true (logarithmic) strain: a spring with a yield stress, a Maxwell branch and a memory (of
/// second Piola-Kirchhoff stress), stiffening chains and softening, in one dimension.
class Strand {
 public:
  Strand(const Truth& truth, double rigid_fraction, const Making& making)
      : effects_(truth.effects), past_(truth, rigid_fraction) {
    // What relaxes is integrated here, so that the modulus without it is wanted.
    Truth relaxed = truth;
    relaxed.effects.rate_overstress = relaxed.effects.soft_overstress = 0.0;
    relaxed.effects.rate_exponent = relaxed.effects.two_overstresses = 0.0;
    lame_ = homogeneous_lame(relaxed, rigid_fraction, making);
    const double rigid = std::max(0.0, 2.0 * rigid_fraction - 1.0), soft = std::max(0.0, 1.0 - 2.0 * rigid_fraction);
    if (effects_.rigid_yield_pa > 0.0 && rigid > 0.0) yield_pa_ = effects_.rigid_yield_pa / rigid;
    if (effects_.soft_stiffening_limit > 0.0) inverse_limit_ = soft / effects_.soft_stiffening_limit;
    overstress_ = effects_.rate_overstress > 0.0 ? effects_.rate_overstress : effects_.soft_overstress * soft;
    relaxation_s_ = effects_.rate_overstress > 0.0 ? effects_.rate_relaxation_s : effects_.soft_relaxation_s;
    const auto& eta = truth.toughness;
    const double low = std::log(rigid_fraction < 0.5 ? eta.w_tb_j_per_m3 : eta.w_if_j_per_m3),
                 high = std::log(rigid_fraction < 0.5 ? eta.w_if_j_per_m3 : eta.w_vw_j_per_m3);
    threshold_ =
        std::exp(low + (high - low) * (rigid_fraction < 0.5 ? 2.0 * rigid_fraction : 2.0 * rigid_fraction - 1.0));
  }

  /// Nominal stress after a further step to `strain` within `dt_s`.
  double pull(double strain, double dt_s) {
    advance(strain, dt_s);
    return stress_pa();
  }
  /// A part of such a step.
  void advance(double strain, double dt_s) {
    const double elastic = std::log1p(strain) - flow_;
    double kirchhoff = elastic_stress(elastic);
    if (std::abs(kirchhoff) > yield_pa_) {
      const double modulus = (elastic_stress(elastic + 1e-6) - kirchhoff) / 1e-6;
      const double more = (std::abs(kirchhoff) - yield_pa_) / modulus;
      flow_ += std::copysign(more, kirchhoff);
      kirchhoff = std::copysign(yield_pa_, kirchhoff);
    }
    work_ += 0.5 * (kirchhoff + last_) * (std::log1p(strain) - last_log_);
    const double stretch = 1.0 + strain, second = kirchhoff / (stretch * stretch);
    if (overstress_ > 0.0) {
      const double kept = std::exp(-dt_s / relaxation_s_);
      branch_ = kept * (branch_ + overstress_ * (second - last_second_));
    }
    last_second_ = second;
    last_ = kirchhoff;
    last_log_ = std::log1p(strain);
    last_strain_ = strain;
    integrity_ = std::min(integrity_, left());
    passed_s_ += dt_s;
  }
  /// Energy taken up, of that which parts it.
  double spent() const { return work_ / threshold_; }

 private:
  /// Nominal stress at the end of a step.
  double stress_pa() {
    double second = last_second_;
    if (past_.any()) {
      past_.add(last_second_, std::exchange(passed_s_, 0.0));
      second = past_.left_pa();
    }
    return integrity_ * (1.0 + last_strain_) * (second + branch_);
  }
  /// Kirchhoff stress of the law at a logarithmic strain with no sideways stress.
  double elastic_stress(double log_strain) const {
    constexpr int kHalvings = 60;
    // The logarithmic strain sideways lies between none and that of constant area.
    double wide = 0.0, narrow = -log_strain;
    const auto stiffened = [&](double sideways) {
      const double chains = std::expm1(2.0 * log_strain) + std::expm1(2.0 * sideways) - 2.0 * (log_strain + sideways);
      return lame_.mu_pa / (1.0 - std::min(inverse_limit_ * chains, 0.98));
    };
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (wide + narrow);
      const double sideways_pa = stiffened(middle) * std::expm1(2.0 * middle) + lame_.lambda_pa * (log_strain + middle);
      ((sideways_pa > 0.0) == (log_strain > 0.0) ? wide : narrow) = middle;
    }
    const double sideways = 0.5 * (wide + narrow);
    return stiffened(sideways) * std::expm1(2.0 * log_strain) + lame_.lambda_pa * (log_strain + sideways);
  }
  double left() const {
    const double s = std::sqrt(std::max(0.0, work_) / threshold_), v = effects_.progressive_damage,
                 w = effects_.drawn_out_damage;
    if (s <= 1.0) return 1.0;
    if (w > 0.0) return std::pow(1.0 + (s - 1.0) / w, -3.0) / s;
    return v > 0.0 ? std::max(0.0, (1.0 + v - s) / (s * v)) : 1.0;
  }

  HiddenEffects effects_;
  PastStresses past_;
  double passed_s_ = 0.0;  ///< since the last stress that the past holds
  material::Lame lame_;
  double yield_pa_ = 1e30, inverse_limit_ = 0.0, overstress_ = 0.0, relaxation_s_ = 1.0, threshold_ = 1e30;
  double flow_ = 0.0, branch_ = 0.0, last_second_ = 0.0, last_ = 0.0, last_strain_ = 0.0, last_log_ = 0.0, work_ = 0.0,
         integrity_ = 1.0;
};

/// A strand on its way through a programme with pauses, which keeps what is recorded.
class PausedStrand {
 public:
  PausedStrand(const Strand& strand, double rate_per_s) : strand_(strand), rate_per_s_(rate_per_s) {}

  void pull_to(double strain, double step) {
    const double from = recorded_.strain.back();
    const int points = std::max(1, static_cast<int>(std::lround(std::abs(strain - from) / step)));
    for (int i = 1; i <= points; ++i) pull_by((strain - from) / points);
  }

  void hold(double time_s) {
    for (const double part : parts_of(time_s)) record(recorded_.strain.back(), part);
  }

  /// Back at the machine's rate, until no force is left.
  void unload(double step) {
    while (recorded_.stress_pa.back() > 0.0) {
      const Strand before = strand_;
      const double strain = recorded_.strain.back(), stress = recorded_.stress_pa.back();
      pull_by(-step);
      const double over = recorded_.stress_pa.back();
      if (over > 0.0) continue;
      strand_ = before;
      recorded_.strain.back() = strain, recorded_.stress_pa.back() = stress;
      pull_by(-step * stress / (stress - over));  // nearly straight over one step
      recorded_.strain.erase(recorded_.strain.end() - 2);
      recorded_.stress_pa.erase(recorded_.stress_pa.end() - 2);
      break;
    }
  }

  /// Without force.
  void dwell(double time_s) {
    constexpr int kSubsteps = 10;
    for (const double part : parts_of(time_s)) {
      double strain = recorded_.strain.back();
      for (int i = 0; i < kSubsteps; ++i) strain = recovered(strain, part / kSubsteps);
      recorded_.strain.push_back(strain);
      recorded_.stress_pa.push_back(0.0);
    }
  }

  const tester::Curve& recorded() const { return recorded_; }

 private:
  /// Ever longer, so that the fast beginning is resolved.
  static std::vector<double> parts_of(double time_s) {
    constexpr int kParts = 24;
    constexpr double kDecades = 3.0;
    std::vector<double> parts;
    double before = 0.0;
    for (int i = 1; i <= kParts; ++i) {
      const double until = time_s * std::pow(10.0, kDecades * (i - kParts) / kParts);
      parts.push_back(until - before);
      before = until;
    }
    return parts;
  }
  /// Advances to the strain without force: bisection, as the stress rises with the strain.
  double recovered(double strain, double dt_s) {
    double high = strain + 1e-3, low = high - 0.1;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      Strand trial = strand_;
      (trial.pull(middle, dt_s) > 0.0 ? high : low) = middle;
    }
    strand_.pull(0.5 * (low + high), dt_s);
    return 0.5 * (low + high);
  }
  void record(double strain, double dt_s) {
    recorded_.stress_pa.push_back(strand_.pull(strain, dt_s));
    recorded_.strain.push_back(strain);
  }
  void pull_by(double way) {
    constexpr int kSubsteps = 20;
    const double from = recorded_.strain.back(), dt_s = std::abs(way) / kSubsteps / rate_per_s_;
    for (int i = 1; i < kSubsteps; ++i) strand_.advance(from + way * i / kSubsteps, dt_s);
    record(from + way, dt_s);
  }

  Strand strand_;
  double rate_per_s_;
  tester::Curve recorded_{.strain = {0.0}, .stress_pa = {0.0}};
};

}  // namespace

tester::Curve paused_curve(const Truth& truth, double rigid_fraction, const Making& making,
                           const tester::Loading& loading, double step) {
  PausedStrand coupon(Strand(truth, rigid_fraction, making), making.strain_rate_per_s);
  for (std::size_t i = 0; i < loading.turns.size(); ++i) {
    coupon.pull_to(loading.turns[i], step);
    if (i < loading.holds_s.size() && loading.holds_s[i] > 0.0) coupon.hold(loading.holds_s[i]);
  }
  if (loading.dwell_s) coupon.unload(step);
  if (loading.dwell_s.value_or(0.0) > 0.0) coupon.dwell(*loading.dwell_s);
  return coupon.recorded();
}

double coupon_strain(const Truth& truth, double rigid_fraction, const Making& making, double share) {
  constexpr double kStep = 2e-5, kMost = 2.0;
  Strand strand(truth, rigid_fraction, making);
  double strain = 0.0;
  while (strain < kMost && strand.spent() < share) {
    strain += kStep;
    strand.advance(strain, kStep / making.strain_rate_per_s);
  }
  return strain;
}

tester::Curve coupon_curve(const Truth& truth, double rigid_fraction, const Making& making,
                           const std::vector<double>& strains) {
  constexpr int kSubsteps = 20;
  Strand strand(truth, rigid_fraction, making);
  tester::Curve curve{.strain = {strains.front()}, .stress_pa = {0.0}};
  for (std::size_t point = 1; point < strains.size(); ++point) {
    const double from = strains[point - 1], step = (strains[point] - from) / kSubsteps;
    const double dt_s = std::abs(step) / making.strain_rate_per_s;
    for (int i = 1; i < kSubsteps; ++i) strand.advance(from + step * i, dt_s);
    curve.strain.push_back(strains[point]);
    curve.stress_pa.push_back(strand.pull(strains[point], dt_s));
  }
  return curve;
}

}  // namespace nacre::laboratory
