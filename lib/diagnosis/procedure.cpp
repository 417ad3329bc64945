#include "diagnosis/procedure.hpp"

#include <fmt/format.h>

#include "base/hash.hpp"
#include "diagnosis/candidates.hpp"
#include "diagnosis/contrasts.hpp"
#include "diagnosis/outsider.hpp"

namespace nacre::diagnosis {

std::string procedure_text(const DiagnosisSettings& settings) {
  std::string text = fmt::format("kernel {}\nlevels {} {} {}\nsignal {} {} distance {} absorption {}\n",
                                 tester::kKernelVersion, settings.name_level, settings.unexplained_level,
                                 kOutsiderLevel, kVisibleSignal, kNameableSignal, kToldApart, kInvisibleAbsorption);
  for (const material::Effect& effect : material::effect_library()) {
    text += fmt::format("effect {} {}", effect.name, effect.family);
    for (const material::EffectParameter& p : effect.parameters)
      text += fmt::format(" [{} {:a} {:a}]", p.unit, p.minimum, p.maximum);
    text += "\n";
  }
  for (int i = 0; i < kFeatureCount; ++i) text += fmt::format("feature {}\n", to_string(static_cast<Feature>(i)));
  for (const Descriptor& descriptor : descriptors()) text += fmt::format("contrast {}\n", descriptor.name);
  return text;
}

std::string procedure_hash(const DiagnosisSettings& settings) {
  return content_hash(procedure_text(settings)).substr(0, 16);
}

}  // namespace nacre::diagnosis
