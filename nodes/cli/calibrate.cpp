// nacre calibrate: parameters that make the testers agree with a measurement set.

#include <string>

#include "base/files.hpp"
#include "command.hpp"
#include "material/parameters.hpp"
#include "measurement/measurement.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "sysid/offline.hpp"

namespace nacre::cli {
namespace {

struct Options {
  std::string set;
  std::string start;
  std::string out;
  std::string fidelity = "full";
  int budget = 60;
  int modulus_budget = 120;
  int hold_out = 0;
  std::uint64_t seed = 1;
  bool json = false;
};

nlohmann::ordered_json to_json(const sysid::PredictionErrors& errors) {
  nlohmann::ordered_json document = {
      {"E_mean", nullptr}, {"E_max", nullptr}, {"T_mean", nullptr}, {"T_max", nullptr}, {"T_spearman", nullptr}};
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

nlohmann::ordered_json to_json(const sysid::OfflineCalibration& result) {
  nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
  for (const sysid::ParameterEstimate& estimate : result.calibrated.estimates) {
    parameters[estimate.name] = {{"value", estimate.value},
                                 {"interval90", {estimate.low90, estimate.high90}},
                                 {"determined", estimate.determined}};
  }
  return {{"before", {{"fitted", to_json(result.before_fitted)}, {"held_out", to_json(result.before_held_out)}}},
          {"after", {{"fitted", to_json(result.after_fitted)}, {"held_out", to_json(result.after_held_out)}}},
          {"parameters", parameters},
          {"simulations", result.simulations},
          {"fitted", result.fitted},
          {"held_out", result.held_out}};
}

void print_errors(const std::string& name, const sysid::PredictionErrors& before,
                  const sysid::PredictionErrors& after) {
  const auto percent = [](int count, double error) { return count > 0 ? fmt::format("{:.1f} %", 100.0 * error) : "-"; };
  fmt::print("{:<9} E {:>8} -> {:>8}   T {:>8} -> {:>8}   ({} and {} designs)\n", name,
             percent(before.modulus_count, before.modulus_mean), percent(after.modulus_count, after.modulus_mean),
             percent(before.toughness_count, before.toughness_mean),
             percent(after.toughness_count, after.toughness_mean), after.modulus_count, after.toughness_count);
}

void print_table(const sysid::OfflineCalibration& result) {
  print_errors("fitted", result.before_fitted, result.after_fitted);
  if (!result.held_out.empty()) print_errors("held out", result.before_held_out, result.after_held_out);
  for (const sysid::ParameterEstimate& estimate : result.calibrated.estimates) {
    fmt::print("{:<28} {:>12.5g}  90 %: {:.5g} to {:.5g}{}\n", estimate.name, estimate.value, estimate.low90,
               estimate.high90, estimate.determined ? "" : "  (not determined)");
  }
  fmt::print("{} simulations\n", result.simulations);
}

int calibrate(const Options& options) {
  const measurement::MeasurementSet set = measurement::read_measurement_set(options.set);
  warn_about(set, options.set);
  const material::ParameterSet defaults = material::default_parameters();
  sysid::OfflineSettings settings;
  settings.calibration.start = options.start.empty() ? defaults : material::read_parameters(options.start, defaults);
  settings.calibration.toughness_budget = options.budget;
  settings.calibration.modulus_budget = options.modulus_budget;
  settings.calibration.seed = options.seed;
  settings.fidelity = fidelity_from_option(options.fidelity);
  settings.hold_out = options.hold_out;
  Progress progress("calibrate");
  const sysid::OfflineCalibration result = sysid::calibrate_offline(
      set, settings, [&](double share, std::string_view doing) { progress.set_share(share, std::string(doing)); });
  progress.end();
  write_file_atomically(options.out, material::to_toml(result.calibrated.parameters));
  options.json ? print_json(to_json(result)) : print_table(result);
  return 0;
}

}  // namespace

void add_calibrate(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command =
      add_command(app, action, "calibrate", "Fit the parameters to a measurement set", options, calibrate);
  command.add_option("SET", options->set, "Measurement set: a folder with measurements.csv")->required();
  command.add_option("--start", options->start, "Parameter file to begin with; default: the built-in parameters");
  command.add_option("--budget", options->budget, "Evaluations of the toughness set; 0 keeps the toughness parameters")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  command
      .add_option("--modulus-budget", options->modulus_budget,
                  "Evaluations of the modulus set; 0 keeps the modulus parameters")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  command.add_option("--hold-out", options->hold_out, "Whole patterns kept out of the fit, chosen by --seed")
      ->check(CLI::Range(0, 100'000))
      ->capture_default_str();
  command.add_option("--fidelity", options->fidelity, "Size of the specimens: tiny, preview, full")
      ->capture_default_str();
  command.add_option("--seed", options->seed, "Of every random choice")->capture_default_str();
  command.add_option("--out", options->out, "Parameter file to write")->required();
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
