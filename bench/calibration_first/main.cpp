// How well a calibration of few evaluations predicts designs that it has not seen (docs/studies/calibration-first.md):
// a truth is drawn as the virtual laboratory draws its own, random patterns are measured with scatter, some are fitted,
// the others predicted.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "measurement/measurement.hpp"
#include "pattern/random_pattern.hpp"
#include "sysid/offline.hpp"
#include "virtual_lab/laboratory.hpp"

namespace {

using namespace nacre;

struct Study {
  std::string fidelity = "tiny", method = "emulator", source = "tester", start = "";
  int seeds = 5, first_seed = 1, patterns = 10, held_out = 10;
  int toughness_budget = 25, modulus_budget = 120;
  double toughness_scatter = 0.05, modulus_scatter = 0.01;
};

sysid::OfflineSettings offline_settings(const Study& study) {
  sysid::OfflineSettings settings;
  settings.calibration.start = material::default_parameters();
  settings.calibration.modulus_budget = study.modulus_budget;
  settings.calibration.toughness_budget = study.toughness_budget;
  if (study.method == "nlopt") settings.calibration.toughness_search = sysid::ToughnessSearch::trust_region;
  settings.fidelity = tester::fidelity_from_string(study.fidelity).value();
  return settings;
}

std::vector<pattern::Design> random_designs(int count, RandomStream random) {
  std::vector<pattern::Design> designs;
  for (const pattern::Pattern& pattern : pattern::stratified_patterns(count, random)) designs.emplace_back(pattern);
  return designs;
}

/// One specimen per design and test as our own tester sees the truth, with scatter.
std::vector<measurement::SpecimenRecord> measured_by_tester(const virtual_laboratory::Truth& truth,
                                                            const std::vector<pattern::Design>& designs,
                                                            const Study& study) {
  std::vector<measurement::Replicates> asked(designs.size());
  sysid::WantedEvaluation evaluation{"truth", {truth.modulus, truth.toughness, {}}, true, true, {}};
  for (std::size_t i = 0; i < designs.size(); ++i) {
    asked[i].design = designs[i];
    evaluation.items.push_back(i);
  }
  const auto predictions = sysid::LocalSimulator(truth.fidelity, 0).simulate(asked, {evaluation}).front();
  RandomStream scatter(truth.seed, "scatter");
  std::vector<measurement::SpecimenRecord> records;
  for (std::size_t i = 0; i < designs.size(); ++i) {
    measurement::SpecimenRecord record;
    record.design = designs[i];
    record.specimen = fmt::format("E{}", i);
    record.modulus_pa = predictions[i].modulus_pa.value() * std::exp(study.modulus_scatter * scatter.normal());
    records.push_back(record);
    const double stress = std::exp(study.toughness_scatter * scatter.normal());
    if (!predictions[i].toughness_pa) continue;
    record.specimen = fmt::format("T{}", i);
    record.test = tester::TestKind::toughness;
    record.modulus_pa.reset();
    record.toughness_pa = stress * *predictions[i].toughness_pa;
    record.curve = predictions[i].curve;
    for (double& value : record.curve.stress_pa) value *= stress;
    records.push_back(record);
  }
  return records;
}

/// Mean relative error of the best constant (the fitted designs' median) on the held-out designs.
double constant_baseline(const measurement::MeasurementSet& set, const sysid::OfflineCalibration& result) {
  std::vector<double> fitted, held_out;
  for (const measurement::Replicates& design : measurement::summarise(set.specimens)) {
    const bool held = std::binary_search(result.held_out.begin(), result.held_out.end(), design.design.name());
    if (design.toughness_count > 0) (held ? held_out : fitted).push_back(design.toughness_pa);
  }
  if (fitted.empty() || held_out.empty()) return 0.0;
  std::nth_element(fitted.begin(), fitted.begin() + static_cast<std::ptrdiff_t>(fitted.size() / 2), fitted.end());
  double sum = 0.0;
  for (const double value : held_out) sum += std::abs(fitted[fitted.size() / 2] - value) / value;
  return sum / static_cast<double>(held_out.size());
}

void run(std::uint64_t seed, const Study& study) {
  const tester::Fidelity fidelity = tester::fidelity_from_string(study.fidelity).value();
  virtual_laboratory::Truth truth{};
  truth.seed = seed;
  truth.fidelity = fidelity;
  truth.modulus = virtual_laboratory::draw_modulus_parameters(seed);
  truth.toughness = virtual_laboratory::draw_toughness_parameters(seed);
  const auto designs = random_designs(study.patterns + study.held_out, RandomStream(seed, "study/patterns"));
  measurement::MeasurementSet set;
  if (study.source == "tester") {
    set.specimens = measured_by_tester(truth, designs, study);
  } else {
    set.specimens = virtual_laboratory::measure(truth, {.designs = designs});
  }
  sysid::OfflineSettings settings = offline_settings(study);
  settings.calibration.seed = seed;
  settings.hold_out = study.held_out;
  if (!study.start.empty())
    settings.calibration.start = material::read_parameters(study.start, settings.calibration.start);
  const sysid::OfflineCalibration result = sysid::calibrate_offline(set, settings);
  const auto& fit = result.calibrated;
  fmt::print(
      "{:4} {:8} | E obj {:.4f} -> {:.4f}  held {:.3f} -> {:.4f} | T obj {:.3f} -> {:.3f}  fitted {:.3f} -> {:.3f}  "
      "held {:.3f} -> {:.3f} (constant {:.3f})  rank {:.2f} -> {:.2f} | {} sims\n",
      seed, study.method, fit.modulus_objective_before, fit.modulus_objective_after,
      result.before_held_out.modulus_mean, result.after_held_out.modulus_mean, fit.toughness_objective_before,
      fit.toughness_objective_after, result.before_fitted.toughness_mean, result.after_fitted.toughness_mean,
      result.before_held_out.toughness_mean, result.after_held_out.toughness_mean, constant_baseline(set, result),
      result.before_held_out.toughness_spearman, result.after_held_out.toughness_spearman, result.simulations);
  const material::ToughnessVector eta_true = to_vector(truth.toughness);
  const material::ModulusVector theta_true = to_vector(truth.modulus);
  int covered = 0, determined = 0;
  std::string ratios;
  for (std::size_t j = 0; j < fit.estimates.size(); ++j) {
    const auto& estimate = fit.estimates[j];
    const double true_value = j < theta_true.size() ? theta_true[j] : eta_true[j - theta_true.size()];
    if (!estimate.determined) continue;
    ++determined;
    covered += estimate.low90 <= true_value && true_value <= estimate.high90;
    ratios += fmt::format(" {} {:.2f}", estimate.name, estimate.value / true_value);
  }
  fmt::print("     objectives: {:.3f}\n", fmt::join(fit.toughness_objectives, " "));
  fmt::print("     90 % intervals cover {} of {} determined; found / true:{}\n", covered, determined, ratios);
  std::fflush(stdout);
}

/// Fits a measurement set and prints what was reached.
void fit_set(const std::string& folder, const Study& study) {
  const sysid::OfflineSettings settings = offline_settings(study);
  const sysid::OfflineCalibration result =
      sysid::calibrate_offline(measurement::read_measurement_set(folder), settings);
  const sysid::PredictionErrors& errors = result.after_fitted;
  fmt::print("{}: E mean {:.5f} max {:.5f} ({}), T mean {:.4f} max {:.4f} ({}), {} simulations\n{}\n", study.fidelity,
             errors.modulus_mean, errors.modulus_max, errors.modulus_count, errors.toughness_mean, errors.toughness_max,
             errors.toughness_count, result.simulations, material::to_toml(result.calibrated.parameters));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Calibration of few evaluations against a known truth");
  Study study;
  app.add_option("--fidelity", study.fidelity);
  app.add_option("--method", study.method, "emulator or nlopt")->check(CLI::IsMember({"emulator", "nlopt"}));
  app.add_option("--source", study.source, "tester or laboratory (other numerics)")
      ->check(CLI::IsMember({"tester", "laboratory"}));
  app.add_option("--start", study.start, "parameter file to start from");
  app.add_option("--seeds", study.seeds);
  app.add_option("--first-seed", study.first_seed);
  app.add_option("--patterns", study.patterns);
  app.add_option("--held-out", study.held_out);
  app.add_option("--budget", study.toughness_budget);
  app.add_option("--modulus-budget", study.modulus_budget);
  app.add_option("--toughness-scatter", study.toughness_scatter);
  app.add_option("--modulus-scatter", study.modulus_scatter);
  std::string set;
  app.add_option("--set", set, "fit this measurement set instead");
  CLI11_PARSE(app, argc, argv);
  if (!set.empty()) {
    fit_set(set, study);
    return 0;
  }
  for (int k = 0; k < study.seeds; ++k) run(static_cast<std::uint64_t>(study.first_seed + k), study);
}
