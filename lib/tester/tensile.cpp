#include "tester/tensile.hpp"

#include <algorithm>
#include <cmath>

#include "material/pulled_bar.hpp"
#include "tester/coupon_law.hpp"

namespace nacre::tester {
namespace {

/// Strain in one step of the integration along a history; where only the end of a step matters, in one that the width
/// of the bar follows.
constexpr double kStepStrain = 5e-4, kElasticStepStrain = 1e-2;

/// Whether stress depends on how a strain was reached. Softening keeps the largest strain, at which a history turns.
bool depends_on_path(const CouponLaw& law) {
  return std::isfinite(law.law.yield_pa) || law.law.overstress > 0.0 || !law.relaxation.is_elastic();
}

Result<Curve> pull_coupon(const CouponLaw& law, double rate_per_s, const std::vector<double>& strain_history) {
  material::PulledBar coupon = law.bar();
  const double step_strain = depends_on_path(law) ? kStepStrain : kElasticStepStrain;
  Curve curve;
  double strain = 0.0;
  for (const double target : strain_history) {
    const double way = target - strain;
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(way) / step_strain)));
    double stress_pa = 0.0;
    for (int step = 1; step <= steps; ++step) {
      stress_pa = coupon.pull(strain + way * step / steps, std::abs(way) / steps / rate_per_s);
    }
    strain = target;
    if (!std::isfinite(stress_pa)) return fail("tensile tester: the law has no state at strain {}", target);
    curve.strain.push_back(target);
    curve.stress_pa.push_back(stress_pa);
  }
  return curve;
}

}  // namespace

Result<Curve> test_tensile(const Simulation& simulation, const std::vector<double>& strain_history) {
  const auto law = coupon_law(simulation);
  if (!law) return tl::unexpected(law.error());
  for (std::size_t i = 0; i < strain_history.size(); ++i)
    if (!(std::isfinite(strain_history[i]) && strain_history[i] > -1.0))
      return fail("tensile tester: strain {} at sample {}, expected a number above -1", strain_history[i], i);
  material::LawExtensions extensions = material::law_extensions(simulation.parameters.extensions);
  extensions.shrinkage = 0.0;
  if (extensions.any() || !law->relaxation.is_elastic())
    return pull_coupon(*law, simulation.conditions.strain_rate_per_s, strain_history);
  Curve curve;
  for (const double strain : strain_history) {
    curve.strain.push_back(strain);
    curve.stress_pa.push_back(material::uniaxial_stress(strain, law->law.lame).nominal_stress_pa);
  }
  return curve;
}

}  // namespace nacre::tester
