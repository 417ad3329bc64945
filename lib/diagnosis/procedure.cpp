#include "diagnosis/procedure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/hash.hpp"
#include "diagnosis/candidates.hpp"
#include "diagnosis/contrasts.hpp"
#include "diagnosis/discrepancy_model.hpp"
#include "material/effect_library.hpp"
#include "material/extensions.hpp"
#include "tester/simulation_key.hpp"

namespace nacre::diagnosis {
namespace {

std::string procedure_text(const DiagnosisSettings& settings) {
  std::string text = fmt::format("kernel {} fidelity {}\nlevels {} {} {} {} bootstraps {}\n", tester::kKernelVersion,
                                 tester::to_string(settings.fidelity), settings.name_level, settings.unexplained_level,
                                 kExclusionLevel, kDiscrepancyLevel, settings.bootstraps);
  text += fmt::format("leads {} {} contrasts {} {}\n", kOwnLead, kCertainLead, kContrastTie, kEvenLead);
  text += fmt::format("signal {} {} (at the named constants) distance {} sizes {}\n", kVisibleSignal, kNameableSignal,
                      kToldApart, fmt::join(kSizes, " "));
  text += fmt::format("constants {:a}\n", kConstantSd);
  text += fmt::format("floor {:a} {:a} {:a}\n", settings.floor.log_modulus_sd, settings.floor.mesh_amplitude,
                      settings.floor.mesh_remainder_sd);
  if (settings.ranges != material::thesis_ranges()) text += material::to_csv(settings.ranges);
  const FractureDiscretisation& fracture = settings.fracture_discretisation;
  for (const Eigen::MatrixXd* matrix : {&fracture.shared, &fracture.rigid, &fracture.layout})
    text += fmt::format("fracture {:a}\n", fmt::join(matrix->reshaped(), " "));
  for (const material::Effect& effect : material::effect_library()) {
    text += fmt::format("effect {} {}", effect.name, effect.family);
    for (const material::EffectParameter& p : effect.parameters)
      text += fmt::format(" [{} {:a} {:a}]", p.unit, p.minimum, p.maximum);
    text += "\n";
  }
  for (int i = 0; i < kFeatureCount; ++i) text += fmt::format("feature {}\n", to_string(static_cast<Feature>(i)));
  for (const Descriptor& descriptor : descriptors()) text += fmt::format("contrast {}\n", descriptor.name);
  text += "contrast of every batch\n";
  return text;
}

}  // namespace

std::string procedure_hash(const DiagnosisSettings& settings) {
  return content_hash(procedure_text(settings)).substr(0, 16);
}

}  // namespace nacre::diagnosis
