// Part of the calibration study (commands.hpp): round 0, the base materials of Table 3.4, one at a time.

#include <fmt/format.h>

#include <cmath>

#include "case.hpp"
#include "game/reference_tables.hpp"
#include "sysid/offline.hpp"
#include "table.hpp"

namespace nacre::calibration_study {

void study_base_materials(const Options& options) {
  const auto may_go_on = deadline(options.minutes);
  CalibrationTable table(options.out + "/base.csv",
                         {"fidelity", "material", "E_measured", "E_simulated", "E_error", "T_measured", "T_simulated",
                          "T_error", "simulations"},
                         2);
  if (table.has({options.fidelity, "rigid"})) return;
  const std::vector<measurement::Replicates> measured =
      game::read_base_materials(NACRE_SOURCE_DIR "/data/thesis/base_materials.csv");
  sysid::LocalSimulator simulator = kept_simulator(options, options.fidelity);
  sysid::CalibrationSettings settings;
  settings.target = material::FitTarget::base;
  settings.start = material::default_parameters();
  const sysid::Calibrated result =
      sysid::run_calibration(measured, settings, simulator, [&](double, std::string_view) { may_go_on(); });
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double modulus_pa = result.predictions[i].modulus_pa.value_or(0.0),
                 toughness_pa = result.predictions[i].toughness_pa.value_or(0.0);
    const double modulus_error = std::abs(modulus_pa / measured[i].modulus_pa - 1.0);
    const double toughness_error = std::abs(toughness_pa / measured[i].toughness_pa - 1.0);
    table.add({options.fidelity, measured[i].design.name(), fmt::format("{:.6g}", measured[i].modulus_pa),
               fmt::format("{:.6g}", modulus_pa), fmt::format("{:.2e}", modulus_error),
               fmt::format("{:.6g}", measured[i].toughness_pa), fmt::format("{:.6g}", toughness_pa),
               fmt::format("{:.2e}", toughness_error), std::to_string(result.simulations)});
    fmt::print("{} {}: E {:.4f} %, T {:.3f} %\n", options.fidelity, measured[i].design.name(), 100 * modulus_error,
               100 * toughness_error);
  }
}

}  // namespace nacre::calibration_study
