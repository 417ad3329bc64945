#include "offline/calibration_json.hpp"

#include <cmath>

namespace nacre::offline {
namespace {

nlohmann::ordered_json to_json(const sysid::PredictionErrors& errors) {
  nlohmann::ordered_json document = {{"E_mean", nullptr},
                                     {"E_max", nullptr},
                                     {"T_mean", nullptr},
                                     {"T_max", nullptr},
                                     {"T_spearman", nullptr},
                                     {"E_count", errors.modulus_count},
                                     {"T_count", errors.toughness_count}};
  if (errors.modulus_count > 0) {
    document["E_mean"] = errors.modulus_mean;
    document["E_max"] = errors.modulus_max;
  }
  if (errors.toughness_count > 0) {
    document["T_mean"] = errors.toughness_mean;
    document["T_max"] = errors.toughness_max;
  }
  constexpr int kFewestToRank = 3;
  if (errors.toughness_count >= kFewestToRank) document["T_spearman"] = errors.toughness_spearman;
  return document;
}

nlohmann::ordered_json to_json(const sysid::GoodnessOfFit& fit) {
  if (fit.count == 0) return nullptr;
  const auto if_tested = [&](const nlohmann::ordered_json& value) {
    return fit.tested() ? value : nlohmann::ordered_json(nullptr);
  };
  return {{"designs", fit.count},
          {"freedom", fit.freedom},
          {"chi_squared", fit.chi_squared},
          {"chi_squared_replicates", fit.chi_squared_replicates},
          {"p_value", if_tested(fit.p_value)},
          {"misfit", if_tested(fit.misfit())}};
}

/// log simulated - log measured of every fitted design.
nlohmann::ordered_json residuals_of(const sysid::OfflineCalibration& result) {
  const auto log_ratio = [](int count, const std::optional<double>& simulated,
                            double measured) -> nlohmann::ordered_json {
    return count > 0 && simulated ? nlohmann::ordered_json(std::log(*simulated / measured))
                                  : nlohmann::ordered_json(nullptr);
  };
  nlohmann::ordered_json residuals = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < result.measured.size(); ++i) {
    const measurement::Replicates& measured = result.measured[i];
    const sysid::Prediction& predicted = result.calibrated.predictions[i];
    residuals.push_back(
        {{"design", measured.design.name()},
         {"specimens", measured.specimens},
         {"log_modulus", log_ratio(measured.modulus_count, predicted.modulus_pa, measured.modulus_pa)},
         {"log_toughness", log_ratio(measured.toughness_count, predicted.toughness_pa, measured.toughness_pa)}});
  }
  return residuals;
}

/// How specimens of a design scatter in log T; nothing where strength_cv was not fitted.
nlohmann::ordered_json scatter_json(const std::optional<sysid::StrengthVariation>& fitted) {
  if (!fitted) return nullptr;
  return {{"measured_sd", fitted->measured_sd},
          {"predicted_sd", fitted->predicted_sd},
          {"measuring_sd", fitted->measuring_sd},
          {"correlation", fitted->correlation},
          {"freedom", fitted->freedom}};
}

}  // namespace

nlohmann::ordered_json to_json(const sysid::OfflineCalibration& result) {
  const sysid::Calibrated& calibrated = result.calibrated;
  nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
  for (const sysid::ParameterEstimate& estimate : calibrated.estimates) {
    parameters[estimate.name] = {{"value", estimate.value},
                                 {"interval90", {estimate.low90, estimate.high90}},
                                 {"determined", estimate.determined}};
  }
  nlohmann::ordered_json after = {{"fitted", to_json(result.after_fitted)},
                                  {"held_out", to_json(result.after_held_out)}};
  if (result.ensemble_held_out.toughness_count > 0) after["held_out_ensemble"] = to_json(result.ensemble_held_out);
  return {{"before", {{"fitted", to_json(result.before_fitted)}, {"held_out", to_json(result.before_held_out)}}},
          {"after", after},
          {"parameters", parameters},
          {"scatter", scatter_json(calibrated.strength_variation)},
          {"simulations", result.simulations},
          {"begun_simulations", result.begun_simulations},
          {"fitted", result.fitted},
          {"held_out", result.held_out},
          {"left_out", result.left_out},
          {"objective",
           {{"modulus", {calibrated.modulus_objective_before, calibrated.modulus_objective_after}},
            {"toughness", {calibrated.toughness_objective_before, calibrated.toughness_objective_after}}}},
          {"deviance", {{"modulus", calibrated.modulus_deviance}, {"toughness", calibrated.toughness_deviance}}},
          {"goodness_of_fit",
           {{"modulus", to_json(calibrated.modulus_fit)}, {"toughness", to_json(calibrated.toughness_fit)}}},
          {"convergence", {{"modulus", calibrated.modulus_objectives}, {"toughness", calibrated.toughness_objectives}}},
          {"searches", calibrated.search_objectives},
          {"residuals", residuals_of(result)}};
}

}  // namespace nacre::offline
