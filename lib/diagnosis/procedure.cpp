#include "diagnosis/procedure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/hash.hpp"
#include "diagnosis/contrasts.hpp"
#include "diagnosis/possible_tests.hpp"
#include "diagnosis/procedure_fields.hpp"
#include "diagnosis/settings.hpp"
#include "material/effect_library.hpp"
#include "material/extensions.hpp"
#include "tester/simulation_key.hpp"

namespace nacre::diagnosis {
namespace {

static_assert(Procedure{}.tests.planned_sizes[Procedure{}.tests.planned_typical] ==
              Procedure{}.fit.sizes[Procedure{}.fit.typical]);

/// Writes every number of a procedure behind its name, to the bit.
struct NumberWriter {
  std::string text = {};
  void operator()(std::string_view name, const auto& value) {
    text += name;
    if constexpr (HasFields<std::remove_cvref_t<decltype(value)>>) {
      text += ":\n";
      walk_fields(*this, value);
    } else if constexpr (requires { value.begin(); }) {
      text += fmt::format(" {}\n", fmt::join(value, " "));
    } else {
      text += fmt::format(" {}\n", value);
    }
  }
};

std::string numbers_of(const Procedure& procedure) {
  NumberWriter writer;
  walk_fields(writer, procedure);
  return writer.text;
}

std::string floors_of(const ModulusFloor& modulus, const FractureDiscretisation& fracture) {
  std::string text =
      fmt::format("floor {} {} {}\n", modulus.log_modulus_sd, modulus.mesh_amplitude, modulus.mesh_remainder_sd);
  for (const Feature feature : fracture.features) text += fmt::format("fracture feature {}\n", to_string(feature));
  for (const Eigen::MatrixXd* matrix : {&fracture.shared, &fracture.rigid, &fracture.layout})
    text += fmt::format("fracture {}\n", fmt::join(matrix->reshaped(), " "));
  return text;
}

/// Effects, features, descriptors and the coupons that are ordered.
std::string definitions() {
  std::string text;
  for (const auto table : {material::effect_library(), material::condition_laws()}) {
    for (const material::Effect& effect : table) {
      text += fmt::format("effect {} {}", effect.name, effect.family);
      for (const material::EffectParameter& p : effect.parameters)
        text += fmt::format(" [{} {} {}]", p.unit, p.minimum, p.maximum);
      text += "\n";
    }
  }
  for (int i = 0; i < kFeatureCount; ++i) text += fmt::format("feature {}\n", to_string(static_cast<Feature>(i)));
  for (const Descriptor& descriptor : descriptors()) text += fmt::format("contrast {}\n", descriptor.name);
  return text + fmt::format("coupons {}\n", tester::to_string(coupon_loading()));
}

}  // namespace

std::string procedure_hash(const DiagnosisSettings& settings) {
  std::string text = fmt::format("kernel {} fidelity {} bootstraps {}\n", tester::kKernelVersion,
                                 tester::to_string(settings.fidelity), settings.bootstraps);
  text += numbers_of(settings.procedure) + floors_of(settings.floor, settings.fracture_discretisation) + definitions() +
          material::to_csv(settings.ranges);
  return content_hash(text).substr(0, 16);
}

}  // namespace nacre::diagnosis
