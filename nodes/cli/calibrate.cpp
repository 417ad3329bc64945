// Part of the command line (command.hpp): nacre calibrate, parameters that make the testers agree with a measurement
// set.

#include <algorithm>
#include <string>

#include <fmt/ranges.h>

#include "base/counted.hpp"
#include "base/files.hpp"
#include "base/output_path.hpp"
#include "command.hpp"
#include "material/parameter_file.hpp"
#include "material/parameters.hpp"
#include "offline/calibration_json.hpp"
#include "offline/specimen_units.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "shipped_files.hpp"
#include "sysid/offline.hpp"
#include "sysid/provenance.hpp"
#include "thesis/constants.hpp"

namespace nacre::cli {
namespace {

struct CalibrateOptions {
  std::string set;
  std::string start, ranges;
  std::string out;
  std::string fidelity = "full", begin_at;
  int budget = 60;
  int modulus_budget = 120;
  int hold_out = 0;
  std::string search = "posterior";
  int searches = 1;
  int ensemble = 0;
  std::string discretisation_floor;
  std::string store;
  std::uint64_t seed = 1;
  bool json = false;
};

/// Whether the residuals can be noise.
void print_fit(std::string_view what, const sysid::GoodnessOfFit& fit) {
  if (fit.count == 0) return;
  if (!fit.tested()) {
    fmt::print(
        "{}: not tested, because the fit of its {} leaves less than one degree of freedom (chi squared {:.1f})\n", what,
        counted(fit.count, "design"), fit.chi_squared);
    return;
  }
  fmt::print(
      "{}: {} (chi squared {:.1f} at {} degrees of freedom, p {:.3g}; with the scatter of replicates alone "
      "{:.1f})\n",
      what,
      fit.misfit() ? "MISFIT: scatter and discretisation error do not explain the residuals"
                   : "residuals are noise: scatter and discretisation error explain them",
      fit.chi_squared, fit.freedom, fit.p_value, fit.chi_squared_replicates);
}

void print_errors(const std::string& name, const sysid::PredictionErrors& before,
                  const sysid::PredictionErrors& after) {
  const auto percent = [](int count, double error) { return count > 0 ? fmt::format("{:.1f} %", 100.0 * error) : "-"; };
  fmt::print("{:<16} E {:>8} -> {:>8} ({})   T {:>8} -> {:>8} ({})\n", name,
             percent(before.modulus_count, before.modulus_mean), percent(after.modulus_count, after.modulus_mean),
             counted(after.modulus_count, "design"), percent(before.toughness_count, before.toughness_mean),
             percent(after.toughness_count, after.toughness_mean), counted(after.toughness_count, "design"));
}

/// Cautions that the numbers do not show by themselves.
void print_reservations(const sysid::OfflineCalibration& result, const material::ParameterRanges& ranges) {
  const auto target = result.base_materials ? material::FitTarget::base : material::FitTarget::microstructures;
  for (const sysid::ParameterEstimate& each : sysid::at_an_end(result.calibrated, ranges, target))
    remark(fmt::format("{} is at its bound: the true value may lie beyond; other inks may need wider ranges (--ranges)",
                       each.name));
  for (std::size_t i = 0; i < result.measured.size(); ++i) {
    if (sysid::is_unbroken(result.calibrated.predictions[i], result.measured[i].design))
      remark(fmt::format(
          "{} does not break within {:g} % strain, where a simulated test ends: its T is the area up to there",
          result.measured[i].design.name(), 100.0 * thesis::kStrainLimit));
  }
  const auto repeated = [](const measurement::Replicates& r) { return r.modulus_count > 1 || r.toughness_count > 1; };
  if (std::ranges::none_of(result.measured, repeated))
    remark("no design was measured twice: a scatter of 1 % of E and 5 % of T is assumed");
}

void print_table(const sysid::OfflineCalibration& result, const material::ParameterRanges& ranges) {
  fmt::print("mean prediction error before -> after the calibration\n");
  // Designs that the fit has not seen come first: they show how far the model can be trusted.
  if (!result.held_out.empty()) print_errors("designs held out", result.before_held_out, result.after_held_out);
  print_errors("designs fitted", result.before_fitted, result.after_fitted);
  fmt::print("parameters, with 90 % intervals\n");
  for (const sysid::ParameterEstimate& estimate : result.calibrated.estimates) {
    fmt::print("{:<28} {:>12.5g}  {:.5g} to {:.5g}{}\n", estimate.name, estimate.value, estimate.low90, estimate.high90,
               estimate.determined ? "" : "  (these data do not determine it)");
  }
  if (result.ensemble_held_out.toughness_count > 0) {
    fmt::print("designs held out, mean of the ensemble's predictions: T {:.1f} %\n",
               100.0 * result.ensemble_held_out.toughness_mean);
  }
  if (const auto& scatter = result.calibrated.strength_variation)
    fmt::print("replicates scatter by {:.1f} % in T, {:.1f} % by the model; measuring alone by {:.1f} %\n",
               100.0 * scatter->measured_sd, 100.0 * scatter->predicted_sd, 100.0 * scatter->measuring_sd);
  print_reservations(result, ranges);
  print_fit("E", result.calibrated.modulus_fit);
  print_fit("T", result.calibrated.toughness_fit);
  fmt::print("{}", counted(result.simulations, "simulation"));
  if (result.begun_simulations > 0) fmt::print(" and {} of the cheaper fidelity", result.begun_simulations);
  fmt::print("\n");
}

int calibrate(const CalibrateOptions& options) {
  prepare_output_file(options.out, {options.set, options.ranges, options.discretisation_floor, options.store});
  const measurement::MeasurementSet set = measurement::read_plausible_set(options.set);
  warn_about(set, options.set);
  sysid::OfflineSettings settings;
  const material::StartingModel model = starting_model_from_options(options.start, options.ranges);
  settings.calibration.ranges = model.ranges;
  settings.calibration.start = model.parameters;
  settings.calibration.toughness_budget = options.budget;
  settings.calibration.modulus_budget = options.modulus_budget;
  settings.calibration.seed = options.seed;
  const auto search = sysid::toughness_search_from_string(options.search);
  if (!search) throw InputError("--search: " + search.error().message);
  if (options.searches > 1 && !sysid::draws(*search))
    throw InputError::format("--searches: {} uses no random numbers, so that several are all the same; expected 1",
                             options.search);
  settings.calibration.toughness_search = *search;
  settings.calibration.searches = options.searches;
  settings.calibration.ensemble_size = options.ensemble;
  settings.fidelity = fidelity_from_option(options.fidelity);
  warn_all(offline::specimen_unit_doubts(set.specimens, {settings.calibration.start, settings.calibration.start},
                                         settings.fidelity)
               .first);
  settings.hold_out = options.hold_out;
  settings.store = options.store;
  settings.calibration.floor =
      sysid::read_discretisation_floor(discretisation_floor_file(options.discretisation_floor), settings.fidelity);
  if (!options.begin_at.empty()) {
    settings.begin_at = fidelity_from_option(options.begin_at);
    if (*settings.begin_at >= settings.fidelity)
      throw InputError::format("--begin-at {}: expected a cheaper fidelity than {}", options.begin_at,
                               options.fidelity);
    settings.begin_at_floor =
        sysid::read_discretisation_floor(discretisation_floor_file(options.discretisation_floor), *settings.begin_at);
  }
  Progress progress("calibrate");
  const sysid::OfflineCalibration result = sysid::calibrate_offline(
      set, settings, [&](double share, std::string_view doing) { progress.set_share(share, std::string(doing)); });
  progress.end();
  if (!result.left_out.empty())
    remark(fmt::format("{}: left out, the fit is of {} alone", fmt::join(result.left_out, ", "),
                       result.base_materials ? "soft, rigid and interface" : "patterns"));
  write_file_atomically(options.out, material::to_toml(result.calibrated.parameters));
  nlohmann::ordered_json document = offline::to_json(result);
  document["rejected"] = rejected_json(set.rejected);
  options.json ? print_json(document) : print_table(result, model.ranges);
  return 0;
}

}  // namespace

void add_calibrate(CLI::App& app, Action& action) {
  const auto options = std::make_shared<CalibrateOptions>();
  CLI::App& command =
      add_command(app, action, "calibrate", "Fit the model's parameters to a measurement set", options, calibrate);
  command.add_option("SET", options->set, "Measurement set: a folder with measurements.csv")->required();
  command.add_option("--start", options->start,
                     "Parameter file with the initial guess; default: the built-in parameters");
  add_ranges(command, options->ranges);
  command
      .add_option("--budget", options->budget,
                  "Most parameter sets tried for toughness; 0 keeps the toughness parameters")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  command
      .add_option("--modulus-budget", options->modulus_budget,
                  "Most parameter sets tried for the modulus; 0 keeps the modulus parameters")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  command
      .add_option("--hold-out", options->hold_out,
                  "How many patterns to keep out of the fit, to test it on; chosen by --seed")
      ->check(CLI::Range(0, 100'000))
      ->capture_default_str();
  command
      .add_option("--search", options->search,
                  "How the toughness parameters are found: posterior (recommended), emulator, gauss_newton, bayesian, "
                  "trust_region, random, direct_l, crs2, cma_es")
      ->capture_default_str();
  command
      .add_option("--searches", options->searches,
                  "Number of searches, each with its own seed; for searches that use random numbers")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      .add_option("--ensemble", options->ensemble,
                  "Number of plausible parameter sets whose mean also predicts the designs held out")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command.add_option("--discretisation-floor", options->discretisation_floor,
                     "File of discretisation errors; default: data/discretisation_floor.toml");
  command.add_option("--store", options->store,
                     "File that keeps the simulations, so that an interrupted calibration goes on");
  add_fidelity(command, options->fidelity)->capture_default_str();
  command.add_option("--begin-at", options->begin_at,
                     "Cheaper fidelity to calibrate at first: its result is the initial guess");
  add_seed(command, options->seed, "Seed of every random choice")->capture_default_str();
  command.add_option("--out", options->out, "Parameter file to write")->required();
  command.add_flag("--json", options->json, "One JSON document on standard output");
}

}  // namespace nacre::cli
