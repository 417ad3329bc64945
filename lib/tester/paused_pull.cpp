#include "tester/paused_pull.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "material/pulled_bar.hpp"
#include "tester/coupon_law.hpp"

namespace nacre::tester {
namespace {

constexpr double kProgrammeStep = 5e-4;  // of one step, as in a pull without pauses
constexpr int kPauseSteps = 40;

/// A coupon on its way through a programme.
class PausedCoupon {
 public:
  PausedCoupon(const CouponLaw& law, double rate_per_s) : bar_(law.bar()), rate_per_s_(rate_per_s) {}

  double strain() const { return strain_; }
  double stress_pa() const { return stress_pa_; }

  void pull_to(double strain) {
    const double from = strain_, way = strain - from;
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(way) / kProgrammeStep)));
    for (int step = 1; step <= steps; ++step) advance(from + way * step / steps, std::abs(way) / steps / rate_per_s_);
  }

  /// Holds the strain; branches decay exactly over a step without strain.
  void hold(double time_s) { advance(strain_, time_s); }

  void unload() {
    while (stress_pa_ > 0.0) {
      const double step = std::min(kProgrammeStep, 0.1 * (1.0 + strain_));
      if (stress_after(strain_ - step, step / rate_per_s_) > 0.0) {
        advance(strain_ - step, step / rate_per_s_);
        continue;
      }
      // The step that crosses zero force is as long as it takes.
      double least = 0.0, most = step;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (least + most);
        (stress_after(strain_ - middle, middle / rate_per_s_) > 0.0 ? least : most) = middle;
      }
      return advance(strain_ - most, most / rate_per_s_);
    }
  }

  /// Stays at zero force, in steps that grow with the time passed.
  void dwell(double time_s) {
    const double first_s = 0.01 * time_s;
    const double growth = std::pow(time_s / first_s, 1.0 / kPauseSteps);
    for (double passed = 0.0, next = first_s; passed < time_s; passed = next, next *= growth) {
      next = std::min(next, time_s);
      recover(next - passed);
    }
  }

 private:
  void advance(double strain, double dt_s) {
    stress_pa_ = bar_.pull(strain, dt_s);
    strain_ = strain;
  }
  double stress_after(double strain, double dt_s) const {
    material::PulledBar trial = bar_;
    return trial.pull(strain, dt_s);
  }
  /// To the strain that bears no force after the time: secants on a stress that rises with strain.
  void recover(double dt_s) {
    double last = strain_, now = strain_ - 1e-6;
    double last_pa = stress_after(last, dt_s), now_pa = stress_after(now, dt_s);
    for (int i = 0; i < 60 && now_pa != last_pa && std::abs(now - last) > 1e-13; ++i) {
      const double next = now - now_pa * (now - last) / (now_pa - last_pa);
      last = now, last_pa = now_pa;
      now = next, now_pa = stress_after(now, dt_s);
    }
    advance(now, dt_s);
  }

  material::PulledBar bar_;
  double rate_per_s_, strain_ = 0.0, stress_pa_ = 0.0;
};

}  // namespace

Result<PausedPull> pull_with_pauses(const Simulation& simulation, const Loading& loading) {
  if (loading.turns.empty()) return fail("tensile tester: a programme without strains, expected one with pauses");
  const double holds_s = std::accumulate(loading.holds_s.begin(), loading.holds_s.end(), 0.0);
  const auto law = coupon_law(simulation, holds_s + loading.dwell_s.value_or(0.0));
  if (!law) return tl::unexpected(law.error());
  PausedCoupon coupon(*law, simulation.conditions.strain_rate_per_s);
  PausedPull shown;
  for (std::size_t i = 0; i < loading.turns.size(); ++i) {
    coupon.pull_to(loading.turns[i]);
    if (i == 0) shown.turn_stress_pa = coupon.stress_pa();
    if (i >= loading.holds_s.size() || loading.holds_s[i] == 0.0) continue;
    coupon.hold(loading.holds_s[i]);
    if (i == 0) shown.held_stress_pa = coupon.stress_pa();
  }
  if (loading.dwell_s) {
    coupon.unload();
    shown.set_strain = coupon.strain();
    if (*loading.dwell_s > 0.0) {
      coupon.dwell(*loading.dwell_s);
      shown.dwelled_strain = coupon.strain();
    }
  }
  if (!std::isfinite(coupon.stress_pa()) || !std::isfinite(coupon.strain()))
    return fail("tensile tester: the law has no state along \"{}\"", to_string(loading));
  return shown;
}

}  // namespace nacre::tester
