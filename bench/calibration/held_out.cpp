// Part of the calibration study (commands.hpp): calibration on some designs of a laboratory, predictions of others.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "baselines.hpp"
#include "case.hpp"
#include "study_laboratory.hpp"
#include "sysid/offline.hpp"
#include "table.hpp"

namespace nacre::calibration_study {
namespace {

using sysid::Calibrated;
using sysid::PredictionErrors;

const std::vector<std::string> kColumns = {"fidelity",
                                           "effect",
                                           "criterion",
                                           "seed",
                                           "search",
                                           "fitted",
                                           "budget",
                                           "simulations",
                                           "E_objective",
                                           "T_objective",
                                           "T_deviance",
                                           "E_fitted",
                                           "T_fitted",
                                           "E_before",
                                           "E_held_out",
                                           "T_before",
                                           "T_held_out",
                                           "spearman_before",
                                           "spearman",
                                           "T_ensemble",
                                           "spearman_ensemble",
                                           "inside90",
                                           "E_line",
                                           "T_constant",
                                           "T_line",
                                           "spearman_line",
                                           "E_floor",
                                           "T_floor",
                                           "spearman_floor",
                                           "covered",
                                           "determined",
                                           "E_p_value",
                                           "T_p_value",
                                           "E_chi2_replicates",
                                           "T_chi2_replicates",
                                           "strength_cv_true",
                                           "strength_cv",
                                           "strength_cv_low90",
                                           "strength_cv_high90",
                                           "scatter_measured",
                                           "scatter_predicted"};
constexpr std::size_t kKeyColumns = 7;

std::string number(double value, int digits = 4) { return fmt::format("{:.{}f}", value, digits); }

struct Coverage {
  int covered = 0, determined = 0;
};

/// How many of the determined parameters have their true value in the 90 % interval; adds a row to `intervals`, behind
/// `cells`, for every parameter.
Coverage coverage_of(const Calibrated& calibrated, const laboratory::Truth& truth,
                     const std::vector<std::string>& cells, CalibrationTable& intervals) {
  const material::ParameterSet of_testers = as_tester_parameters(truth);
  const material::ModulusVector theta = to_vector(of_testers.modulus);
  const material::ToughnessVector eta = to_vector(of_testers.toughness);
  Coverage coverage;
  for (std::size_t j = 0; j < calibrated.estimates.size(); ++j) {
    const sysid::ParameterEstimate& estimate = calibrated.estimates[j];
    const std::size_t k = j - theta.size();  // behind eta: strength_cv
    const double value = j < theta.size() ? theta[j] : k < eta.size() ? eta[k] : of_testers.strength_cv;
    std::vector<std::string> row(cells.begin(), cells.begin() + kKeyColumns);
    row.push_back(estimate.name);
    for (const double number : {value, estimate.value, estimate.low90, estimate.high90})
      row.push_back(fmt::format("{:.5g}", number));
    row.push_back(estimate.determined ? "1" : "0");
    intervals.add(row);
    coverage.determined += estimate.determined;
    coverage.covered += estimate.determined && estimate.low90 <= value && value <= estimate.high90;
  }
  return coverage;
}

/// Share of held-out designs whose measured T lies within the 90 % interval that the members' spread and the floor
/// give.
double inside_90(const std::vector<std::vector<sysid::Prediction>>& members, const StudyCase& study_case,
                 const Calibrated& calibrated, const sysid::DiscretisationFloor& floor) {
  const std::vector<sysid::Prediction> mean = sysid::mean_prediction(members);
  const sysid::GoodnessOfFit& fit = calibrated.toughness_fit;
  const double factor = fit.count > 0 ? (6.0 + fit.chi_squared) / (6.0 + fit.freedom) : 1.0;
  int inside = 0, count = 0;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    if (!mean[i].toughness_pa) continue;
    double spread = 0.0;
    int used = 0;
    for (const auto& member : members) {
      if (!member[i].toughness_pa) continue;
      spread += std::pow(std::log(*member[i].toughness_pa / *mean[i].toughness_pa), 2);
      ++used;
    }
    const double variance = spread / std::max(1, used - 1) + factor * floor.log_toughness_sd * floor.log_toughness_sd;
    ++count;
    inside +=
        std::abs(std::log(*mean[i].toughness_pa / study_case.held_out[i].toughness_pa)) < 1.645 * std::sqrt(variance);
  }
  return count > 0 ? static_cast<double>(inside) / count : 0.0;
}

void append(std::vector<std::string>& cells, std::initializer_list<double> values) {
  for (const double value : values) cells.push_back(number(value));
}

sysid::DiscretisationFloor floor_at(const std::string& fidelity) {
  return sysid::read_discretisation_floor("data/discretisation_floor.toml",
                                          tester::fidelity_from_string(fidelity).value());
}

Calibrated calibrate(const StudyCase& study_case, const sysid::CalibrationSettings& settings, const Options& options,
                     sysid::LocalSimulator& simulator, const std::function<void()>& may_go_on) {
  const auto progress = [&](double, std::string_view) { may_go_on(); };
  if (options.begin_at.empty()) return sysid::run_calibration(study_case.fitted, settings, simulator, progress);
  sysid::LocalSimulator cheaper = kept_simulator(options, options.begin_at);
  return sysid::calibrate_cheaply_first(study_case.fitted, settings, cheaper, floor_at(options.begin_at), simulator,
                                        progress);
}

constexpr int kRound = 8, kMostFitted = 42;  // designs of a round; those that the study has

/// The eight designs that the next round of the growing set brings (Table 3.5), to be predicted before they are fitted.
StudyCase next_round(const StudyCase& now, std::uint64_t seed, const Options& options,
                     const std::function<void()>& may_go_on) {
  Options later = options;
  later.fitted += kRound;
  StudyCase next = measured_case(seed, later, may_go_on);
  const auto is_known = [&](const measurement::Replicates& each) {
    return std::any_of(now.fitted.begin(), now.fitted.end(),
                       [&](const measurement::Replicates& known) { return known.design.name() == each.design.name(); });
  };
  next.held_out.clear();
  std::copy_if(next.fitted.begin(), next.fitted.end(), std::back_inserter(next.held_out), std::not_fn(is_known));
  next.fitted = now.fitted;
  return next;
}

struct Tables {
  CalibrationTable held_out, convergence, intervals, next_round;
};

/// Errors of the first of `sets` and of the mean of all on the next round's designs, as a row behind `cells`.
void add_next_round(std::vector<std::string> cells, const StudyCase& next,
                    const std::vector<material::ParameterSet>& sets, sysid::LocalSimulator& simulator,
                    CalibrationTable& table, const std::function<void()>& may_go_on) {
  const auto predictions = sysid::predict(sets, next.held_out, simulator, may_go_on);
  const PredictionErrors first = sysid::prediction_errors(next.held_out, predictions.front());
  const PredictionErrors mean = sysid::prediction_errors(next.held_out, sysid::mean_prediction(predictions));
  const ErrorFloor floor = floor_of(next, simulator, may_go_on);
  cells.push_back(std::to_string(next.held_out.size()));
  append(cells, {first.modulus_mean, first.toughness_mean, mean.toughness_mean, baselines_of(next).toughness_line,
                 floor.toughness});
  table.add(cells);
}

void study_one(const Options& options, std::uint64_t seed, const std::string& search, Tables& tables,
               const std::function<void()>& may_go_on) {
  std::string effect = options.effects.empty() ? "none" : "";
  for (const std::string& each : options.effects) effect += (effect.empty() ? "" : "+") + each;
  std::vector<std::string> cells = {
      options.fidelity,
      effect,
      options.criterion,
      std::to_string(seed),
      options.begin_at.empty() ? search : fmt::format("{} after {}", search, options.begin_at),
      std::to_string(options.fitted),
      std::to_string(options.budget)};
  const bool wants_next = options.next_round && options.fitted < kMostFitted && !tables.next_round.has(cells);
  if (tables.held_out.has(cells) && !wants_next) return;
  const StudyCase study_case = measured_case(seed, options, may_go_on);
  sysid::LocalSimulator simulator = kept_simulator(options, options.fidelity);
  sysid::CalibrationSettings settings;
  settings.start = material::default_parameters();
  settings.floor = floor_at(options.fidelity);
  settings.toughness_budget = options.budget;
  const auto named = sysid::toughness_search_from_string(search);
  if (!named) throw InputError(named.error().message);
  settings.toughness_search = *named;
  settings.ensemble_size = options.ensemble;
  settings.seed = seed;
  const Calibrated calibrated = calibrate(study_case, settings, options, simulator, may_go_on);
  std::vector<material::ParameterSet> sets = {settings.start, calibrated.parameters};
  sets.insert(sets.end(), calibrated.ensemble.begin(), calibrated.ensemble.end());
  if (wants_next)
    add_next_round(cells, next_round(study_case, seed, options, may_go_on), {sets.begin() + 1, sets.end()}, simulator,
                   tables.next_round, may_go_on);
  if (tables.held_out.has(cells)) return;
  auto predictions = sysid::predict(sets, study_case.held_out, simulator, may_go_on);
  const PredictionErrors before = sysid::prediction_errors(study_case.held_out, predictions[0]);
  const PredictionErrors after = sysid::prediction_errors(study_case.held_out, predictions[1]);
  predictions.erase(predictions.begin());
  const PredictionErrors mean = sysid::prediction_errors(study_case.held_out, sysid::mean_prediction(predictions));
  const Baselines baselines = baselines_of(study_case);
  const ErrorFloor floor = floor_of(study_case, simulator, may_go_on);
  const Coverage coverage = coverage_of(calibrated, study_case.truth, cells, tables.intervals);
  cells.push_back(std::to_string(calibrated.simulations));
  append(cells, {calibrated.modulus_objective_after,
                 calibrated.toughness_objective_after,
                 calibrated.toughness_deviance,
                 calibrated.after.modulus_mean,
                 calibrated.after.toughness_mean,
                 before.modulus_mean,
                 after.modulus_mean,
                 before.toughness_mean,
                 after.toughness_mean,
                 before.toughness_spearman,
                 after.toughness_spearman,
                 mean.toughness_mean,
                 mean.toughness_spearman,
                 inside_90(predictions, study_case, calibrated, settings.floor),
                 baselines.modulus_line,
                 baselines.toughness_constant,
                 baselines.toughness_line,
                 baselines.line_spearman,
                 floor.modulus,
                 floor.toughness,
                 floor.toughness_spearman});
  cells.push_back(std::to_string(coverage.covered));
  cells.push_back(std::to_string(coverage.determined));
  append(cells, {calibrated.modulus_fit.p_value, calibrated.toughness_fit.p_value,
                 calibrated.modulus_fit.chi_squared_replicates, calibrated.toughness_fit.chi_squared_replicates});
  const sysid::StrengthVariation variation = calibrated.strength_variation.value_or(sysid::StrengthVariation{});
  append(cells, {study_case.truth.strength_cv, variation.strength_cv, variation.low90, variation.high90,
                 variation.measured_sd, variation.predicted_sd});
  tables.held_out.add(cells);
  fmt::print(
      "{} {} seed {} {:12} n {} budget {}: T objective {:.3f}  E held out {:.4f}  T held out {:.3f} (mean of ensemble "
      "{:.3f}; line {:.3f}, floor {:.3f})  "
      "spearman {:.2f} ({:.2f}; floor {:.2f})  covered {}/{}\n",
      options.fidelity, effect, seed, cells[4], options.fitted, options.budget, calibrated.toughness_objective_after,
      after.modulus_mean, after.toughness_mean, mean.toughness_mean, baselines.toughness_line, floor.toughness,
      after.toughness_spearman, mean.toughness_spearman, floor.toughness_spearman, coverage.covered,
      coverage.determined);
  std::fflush(stdout);
  for (std::size_t k = 0; k < calibrated.toughness_objectives.size(); ++k) {
    tables.convergence.add({options.fidelity, effect, options.criterion, std::to_string(seed), cells[4],
                            std::to_string(options.fitted), std::to_string(options.budget), std::to_string(k + 1),
                            number(calibrated.toughness_objectives[k])});
  }
}

}  // namespace

void measure_laboratories(const Options& options) {
  const auto may_go_on = deadline(options.minutes);
  for (int seed = options.first_seed; seed < options.first_seed + options.seeds; ++seed) {
    const StudyCase study_case = measured_case(static_cast<std::uint64_t>(seed), options, may_go_on);
    fmt::print("seed {}: {} designs to fit, {} to predict\n", seed, study_case.fitted.size(),
               study_case.held_out.size());
  }
}

void study_held_out(const Options& options) {
  const auto may_go_on = deadline(options.minutes);
  Tables tables = {CalibrationTable(options.out + "/held_out.csv", kColumns, kKeyColumns),
                   CalibrationTable(options.out + "/convergence.csv",
                                    {"fidelity", "effect", "criterion", "seed", "search", "fitted", "budget",
                                     "evaluation", "T_objective"},
                                    kKeyColumns + 1),
                   CalibrationTable(options.out + "/intervals.csv",
                                    {"fidelity", "effect", "criterion", "seed", "search", "fitted", "budget",
                                     "parameter", "truth", "estimate", "low90", "high90", "determined"},
                                    kKeyColumns + 1),
                   CalibrationTable(options.out + "/next_round.csv",
                                    {"fidelity", "effect", "criterion", "seed", "search", "fitted", "budget", "next",
                                     "E_next", "T_next", "T_ensemble", "T_line", "T_floor"},
                                    kKeyColumns)};
  for (int seed = options.first_seed; seed < options.first_seed + options.seeds; ++seed) {
    for (const std::string& search : options.searches) {
      study_one(options, static_cast<std::uint64_t>(seed), search, tables, may_go_on);
    }
  }
}

}  // namespace nacre::calibration_study
