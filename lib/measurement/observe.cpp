#include "material/extensions.hpp"
#include "measurement/measurement.hpp"

namespace nacre::measurement {
namespace {

/// Strain per stress, 1/Pa.
double machine_compliance(const material::Extensions& extensions) {
  return material::extension_value(extensions, "machine_compliance");
}

}  // namespace

double observe_modulus(double modulus_pa, const material::Extensions& extensions) {
  const double compliance = machine_compliance(extensions);
  return compliance == 0.0 ? modulus_pa : modulus_pa / (1.0 + compliance * modulus_pa);
}

tester::Curve observe_curve(const tester::Curve& curve, const material::Extensions& extensions) {
  const double compliance = machine_compliance(extensions);
  tester::Curve shown = curve;
  if (compliance == 0.0) return shown;
  for (std::size_t i = 0; i < shown.size(); ++i) shown.strain[i] += compliance * shown.stress_pa[i];
  return shown;
}

}  // namespace nacre::measurement
