#include "sysid/discretisation_floor.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/toml_file.hpp"

namespace nacre::sysid {

DiscretisationFloor DiscretisationFloor::none() {
  return {.log_modulus_sd = 0.0,
          .log_toughness_sd = 0.0,
          .log_peak_sd = 0.0,
          .log_modulus_common_sd = 0.0,
          .log_toughness_common_sd = 0.0,
          .log_peak_common_sd = 0.0,
          .log_modulus_trend_sd = 0.0,
          .log_toughness_trend_sd = 0.0,
          .log_peak_trend_sd = 0.0,
          .log_eta_sd = {}};
}

DiscretisationFloor read_discretisation_floor(const std::filesystem::path& file, tester::Fidelity fidelity) {
  const toml::table document = read_toml_file(file);
  const toml::table* table = document[tester::to_string(fidelity)].as_table();
  DiscretisationFloor floor;
  if (table == nullptr) return floor;
  const auto read_from = [&](const toml::table& from, std::string_view key, double& value) {
    const toml::node* node = from.get(key);
    if (node == nullptr) return;
    const std::optional<double> number = node->value<double>();
    if (!number || !(std::abs(*number) <= 2.0)) {
      throw InputError::format("{}: {}: expected a number between -2 and 2", place(file.string(), *node), key);
    }
    value = std::abs(*number);
  };
  const auto read = [&](std::string_view key, double& value) { read_from(*table, key, value); };
  read("log_modulus_sd", floor.log_modulus_sd);
  read("log_toughness_sd", floor.log_toughness_sd);
  read("log_peak_sd", floor.log_peak_sd);
  read("log_modulus_sd_rescaled", floor.log_modulus_trend_sd);
  read("log_modulus_mean", floor.log_modulus_common_sd);
  read("log_toughness_mean", floor.log_toughness_common_sd);
  read("log_peak_mean", floor.log_peak_common_sd);
  if (const toml::table* of_eta = (*table)["log_eta_sd"].as_table()) {
    floor.log_eta_sd = {};
    const auto names = material::toughness_parameter_names();
    for (std::size_t j = 0; j < names.size(); ++j) read_from(*of_eta, names[j], floor.log_eta_sd[j]);
    for (const auto& [key, value] : *of_eta) {
      if (std::find(names.begin(), names.end(), key.str()) == names.end())
        throw InputError::format("{}: unknown key {}: expected one of eta's parameters",
                                 place(file.string(), key.source()), key.str());
    }
  }
  const auto read_trend = [&](std::size_t feature, double& value) {
    const toml::node_view<const toml::node> entry = (*table)["covariance_rigid"][feature][feature];
    if (!entry) return;
    const std::optional<double> variance = entry.value<double>();
    if (!variance || !(*variance >= 0.0 && *variance <= 1.0))
      throw InputError::format("{}: covariance_rigid: expected variances between 0 and 1 on its diagonal",
                               place(file.string(), *entry.node()));
    value = std::sqrt(*variance);
  };
  read_trend(1, floor.log_toughness_trend_sd);  // features: log E, log T, log peak, log failure strain
  read_trend(2, floor.log_peak_trend_sd);
  return floor;
}

}  // namespace nacre::sysid
