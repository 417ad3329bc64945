// Part of the calibration study (commands.hpp): Bayesian optimisation as in the thesis, five random points, then 200
// batches of three.

#include <fmt/format.h>

#include <fstream>

#include "case.hpp"
#include "material/ranges.hpp"
#include "optimize/batch_optimizer.hpp"
#include "sysid/errors.hpp"
#include "sysid/objective.hpp"
#include "sysid/offline.hpp"
#include "sysid/weights.hpp"
#include "table.hpp"

namespace nacre::calibration_study {
namespace {

constexpr int kFirstPoints = 5, kBatches = 200, kBatch = 3;

material::ParameterSet parameters_at(const optimize::Point& point) {
  material::ParameterSet set = material::default_parameters();
  material::ToughnessVector eta{};
  const auto ranges = material::thesis_ranges().toughness(material::FitTarget::microstructures);
  for (std::size_t j = 0; j < eta.size(); ++j) eta[j] = from_unit(ranges[j], point[j]);
  set.toughness = material::toughness_from_vector(eta);
  return set;
}

/// What was evaluated before an interruption, one line an evaluation: the value, then the point.
std::vector<optimize::Evaluation> read_log(const std::string& file) {
  std::vector<optimize::Evaluation> evaluated;
  std::ifstream lines(file);
  double value = 0.0;
  while (lines >> value) {
    optimize::Point point(material::kToughnessParameterCount);
    for (double& coordinate : point) lines >> coordinate;
    if (lines) evaluated.push_back({point, value});
  }
  return evaluated;
}

/// What the schedule found, in sample and on the designs that were not fitted.
void add_result(const Options& options, std::uint64_t seed, const optimize::Evaluation& best, int evaluations,
                const StudyCase& study_case, const std::function<void()>& may_go_on) {
  CalibrationTable table(options.out + "/thesis.csv",
                         {"fidelity", "seed", "fitted", "evaluations", "T_objective", "T_held_out", "spearman"}, 4);
  std::vector<std::string> cells = {options.fidelity, std::to_string(seed), std::to_string(options.fitted),
                                    std::to_string(evaluations)};
  if (table.has(cells)) return;
  sysid::LocalSimulator simulator = kept_simulator(options, options.fidelity);
  const auto predicted = sysid::predict({parameters_at(best.point)}, study_case.held_out, simulator, may_go_on);
  const sysid::PredictionErrors errors = sysid::prediction_errors(study_case.held_out, predicted.front());
  for (const double value : {*best.value, errors.toughness_mean, errors.toughness_spearman})
    cells.push_back(fmt::format("{:.4f}", value));
  table.add(cells);
  fmt::print("seed {}: smallest loss {:.4f} in {} evaluations; T held out {:.3f}, spearman {:.2f}\n", seed, *best.value,
             evaluations, errors.toughness_mean, errors.toughness_spearman);
}

void run_schedule(const Options& options, std::uint64_t seed, const std::function<void()>& may_go_on) {
  const StudyCase study_case = measured_case(seed, options, may_go_on);
  const std::vector<double> weights = sysid::sample_weights(study_case.fitted);
  const std::string log = fmt::format("{}/thesis-{}-{}-{}.txt", options.work, options.fidelity, options.fitted, seed);
  std::vector<optimize::Evaluation> evaluated = read_log(log);
  const int unfinished = static_cast<int>(evaluated.size()) % kBatch;  // of the last batch
  evaluated.resize(evaluated.size() - static_cast<std::size_t>(unfinished));
  optimize::BatchOptimizerSettings settings;
  settings.dimension = material::kToughnessParameterCount;
  settings.budget = 6 + kBatches * kBatch;  // five points do not fill two batches of three: six
  settings.batch = kBatch;
  settings.seed = seed;
  settings.first_points = kFirstPoints;
  const auto optimizer = optimize::make_optimizer(optimize::Algorithm::bayesian, settings);
  optimizer->resume(evaluated);
  const auto fidelity = tester::fidelity_from_string(options.fidelity).value();
  for (std::vector<optimize::Point> points = optimizer->ask(); !points.empty(); points = optimizer->ask()) {
    std::vector<sysid::WantedEvaluation> wanted;
    for (const optimize::Point& point : points) {
      sysid::WantedEvaluation evaluation{"", parameters_at(point), false, true, {}};
      for (std::size_t i = 0; i < study_case.fitted.size(); ++i) evaluation.items.push_back(i);
      wanted.push_back(std::move(evaluation));
    }
    sysid::LocalSimulator simulator(fidelity, 0);
    const auto predictions = simulator.simulate(study_case.fitted, wanted, may_go_on);
    std::vector<std::optional<double>> values;
    std::string lines;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double value = sysid::toughness_objective(study_case.fitted, weights, predictions[k]);
      values.push_back(value);
      lines += fmt::format("{}", value);
      for (const double coordinate : points[k]) lines += fmt::format(" {}", coordinate);
      lines += '\n';
    }
    std::ofstream(log, std::ios::app) << lines;
    optimizer->tell(values);
  }
  add_result(options, seed, *optimizer->best(), settings.budget, study_case, may_go_on);
}

}  // namespace

void run_thesis_schedule(const Options& options) {
  const auto may_go_on = deadline(options.minutes);
  for (int seed = options.first_seed; seed < options.first_seed + options.seeds; ++seed) {
    run_schedule(options, static_cast<std::uint64_t>(seed), may_go_on);
  }
}

}  // namespace nacre::calibration_study
