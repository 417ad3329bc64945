#include "diagnosis/predicted_tests.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "diagnosis/shared_discretisation.hpp"
#include "diagnosis/words.hpp"
#include "tester/modulus.hpp"

namespace nacre::diagnosis {
namespace {

using tester::TestKind;

/// The curve of a homogeneous coupon to its first pause, or unloaded on its way; empty when it cannot be pulled so.
tester::Curve coupon_curve(const PossibleTest& test, const material::ParameterSet& set, tester::Fidelity fidelity) {
  auto curve = coupon_through_machine({test.design, set, test.conditions, fidelity}, strains_of(test.pauses));
  return curve ? *std::move(curve) : tester::Curve{};
}

material::ParameterSet parameters_for(const PossibleTest& test, const CoordinateMap& map, const Eigen::VectorXd& u) {
  return test.design.layout() ? map.parameters(u) : map.coupon_parameters(u);
}

/// Predictions of a test by a model, one value per feature that it shows.
FeatureValues predicted_features(const PossibleTest& test, const material::ParameterSet& set,
                                 const FractureSimulation& simulation) {
  const tester::Fidelity fidelity = simulation.fidelity;
  FeatureValues values;
  if (test.test == TestKind::modulus) {
    if (const auto result = tester::test_modulus({test.design, simulated_side(set), test.conditions, fidelity}))
      value_of(values, Feature::log_modulus) =
          std::log(measurement::observe_modulus(result->modulus_pa, set.extensions));
  } else if (test.test == TestKind::tensile) {
    const tester::Curve curve = coupon_curve(test, set, fidelity);
    if (!curve.empty()) values = tensile_features(curve, simulation.reading);
    if (!curve.empty() && test.pauses.has_pauses()) put_pauses(values, {1.0, 1.0, 1.0});  // the model has their values
  } else {
    values = mean_fracture_features(test, set, simulation);
  }
  return values;
}

/// By test and model.
std::vector<std::vector<FeatureValues>> predictions(const std::vector<PossibleTest>& tests,
                                                    const std::vector<Explanation>& models, const FeatureModel& model,
                                                    const FractureSimulation& simulation) {
  std::vector<std::vector<FeatureValues>> seen(tests.size(), std::vector<FeatureValues>(models.size()));
  parallel_for(tests.size() * models.size(), [&](int job) {
    const std::size_t t = static_cast<std::size_t>(job) / models.size(),
                      m = static_cast<std::size_t>(job) % models.size();
    const FittedModel& fit = models[m].model;
    const CoordinateMap map = model.map(fit.effects);
    seen[t][m] = predicted_features(tests[t], parameters_for(tests[t], map, fit.u), simulation);
  });
  return seen;
}

bool is_notched(const Observation& group) { return group.test == TestKind::toughness; }

/// Whether E of a homogeneous specimen's material is unknown: none of it has been pulled, with a notch or without.
bool is_of_unknown_stiffness(const Observation& added, const Observations& measured) {
  return added.design.mixture() != nullptr && std::ranges::none_of(measured.groups, [&](const Observation& g) {
           return g.design == added.design && is_notched(g) == is_notched(added);
         });
}

/// Of the tests of notched homogeneous specimens of which none was measured.
SlopesOfTests slopes_of_notched(const std::vector<PossibleTest>& tests, const std::vector<Explanation>& models,
                                const Evidence& evidence, FractureSimulation simulation) {
  const Observations& measured = evidence.observations;
  simulation.specimens = 1;  // of one material all break alike
  SlopesOfTests slopes;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    const auto is_its = [&](const Observation& g) { return is_notched(g) && g.design == tests[t].design; };
    if (tests[t].way.kind == AddedTest::notched && std::ranges::none_of(measured.groups, is_its))
      slopes[t].resize(models.size());
  }
  std::vector<std::pair<std::size_t, std::size_t>> jobs;
  for (const auto& [t, of_models] : slopes)
    for (std::size_t m = 0; m < models.size(); ++m) jobs.emplace_back(t, m);
  parallel_for(static_cast<int>(jobs.size()), [&](int job) {
    const auto [t, m] = jobs[static_cast<std::size_t>(job)];
    const FittedModel& fit = models[m].model;
    slopes.at(t)[m] =
        fracture_slopes(tests[t], evidence.model.map(fit.effects), fit.u, measured.constant_sd, simulation);
  });
  return slopes;
}

/// Those that are pulled on two machines.
std::vector<std::string> names_of_pieces(const PossibleTest& test, int count) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.push_back(fmt::format("{} {}", in_words(test), i));
  return names;
}

/// Of the same material where moduli of each scatter differently.
std::size_t scatter_of(const Observation& added, const Observations& measured) {
  const auto of_test = static_cast<std::size_t>(added.test);
  if (added.test != TestKind::modulus) return of_test;
  const auto like = std::ranges::find_if(measured.rows, [&](const DataRow& row) {
    return row.kind == RowKind::mean && row.test == added.test &&
           measured.groups[row.group].material() == added.material();
  });
  return like == measured.rows.end() ? of_test : like->scatter;
}

/// Standard deviations of the effects' coordinates, uniform over their ranges.
Eigen::VectorXd sd_of_effects(const FittedModel& model) {
  const Eigen::Index count = model.u.size() - model.base_count;
  return (model.upper - model.lower).tail(count) / std::sqrt(12.0);
}

/// The inverse of the covariance of a model's free coordinates: information of the data, prior of the base constants,
/// and of the effects. `columns`: FittedModel::whitened_columns().
Eigen::LDLT<Eigen::MatrixXd> information(const FittedModel& model, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd normal = columns.transpose() * columns;
  const Eigen::VectorXd sd = sd_of_effects(model);
  for (std::size_t k = 0; k < model.free.size(); ++k)
    if (const int effect = model.free[k] - model.base_count; effect >= 0)
      normal.diagonal()[k] += 1.0 / (sd[effect] * sd[effect]);
  return normal.ldlt();
}

}  // namespace

PredictedTests::PredictedTests(const Evidence& evidence, const std::vector<Explanation>& explanations,
                               const std::vector<PossibleTest>& tests, int replicates)
    : measured_(evidence.observations) {
  const tester::Fidelity fidelity = evidence.settings.fidelity;
  const Procedure& rules = evidence.settings.procedure;
  const FractureSimulation simulation{fidelity, measured_.reading, rules.tests.broken_specimens};
  const auto seen = predictions(tests, explanations, evidence.model, simulation);
  measured_.levels.resize(0, 0);
  added_.reading = measured_.reading;
  added_.constant_sd = measured_.constant_sd;
  added_.machines = measured_.machines;
  added_.materials = measured_.materials;
  same_errors_ = rules.tests.same_errors;
  const FittedModel& first = explanations.front().model;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    Observation group = group_of(tests[t], replicates);
    const auto material = std::ranges::find(measured_.materials, group.material());
    if (material != measured_.materials.end())
      group.material_number = static_cast<int>(material - measured_.materials.begin());
    if (group.test == TestKind::tensile) {
      const CoordinateMap map = evidence.model.map(first.effects);
      group.curve = coupon_curve(tests[t], parameters_for(tests[t], map, first.u), fidelity);
    }
    if (tests[t].second_machine) group.pieces = names_of_pieces(tests[t], replicates);
    rows_of_.push_back(add_group(group, seen[t]));
    first_of_.resize(added_.rows.size(), -1);
    if (!tests[t].second_machine || rows_of_.back().empty()) continue;
    group.machine = *tests[t].second_machine;
    const int row_on_first = rows_of_.back().front();
    rows_of_.back() = add_group(std::move(group), seen[t]);
    first_of_.resize(added_.rows.size(), row_on_first);
  }
  const FeatureModel bench(added_, evidence.model.basis(), fidelity);
  std::vector<FittedModel> added;
  const SlopesOfTests slopes = slopes_of_notched(tests, explanations, evidence, simulation);
  for (std::size_t m = 0; m < explanations.size(); ++m) {
    const FittedModel& model = explanations[m].model;
    added.push_back(linearised(bench, model.effects, model.u));
    for (std::size_t t = 0; t < tests.size(); ++t)
      for (const int row : rows_of_[t])
        if (tests[t].test == TestKind::toughness)
          put_fracture(model, added[m], row, seen[t][m], slopes.contains(t) ? &slopes.at(t)[m] : nullptr);
  }
  join();
  put_own_constants(slopes);
  if (measured_.has_shared_discretisation()) {
    joined_.discretisation_shared.conservativeResize(joined_.size(), Eigen::NoChange);
    joined_.discretisation_shared.bottomRows(added_.size()) = shared_directions(evidence, bench);
  }
  for (std::size_t m = 0; m < explanations.size(); ++m)
    hypotheses_.push_back(hypothesis_of(explanations[m], std::move(added[m]), rules.noise));
  refits_.resize(hypotheses_.size());
  for (std::size_t truth = 0; truth < hypotheses_.size(); ++truth)
    for (const Hypothesis& wrong : hypotheses_) refits_[truth].push_back(refit(hypotheses_[truth], wrong));
}

/// The rows of a test: features that every model shows, but none of unknown discretisation error.
std::vector<int> PredictedTests::add_group(Observation group, const std::vector<FeatureValues>& seen) {
  std::vector<int> rows;
  const bool fracture = group.test == TestKind::toughness;
  const bool discretisation_known = !measured_.fracture_discretisation.features.empty();
  for (std::size_t f = 0; f < kFeatureCount; ++f) {
    const auto feature = static_cast<Feature>(f);
    const auto& known = measured_.fracture_discretisation.features;
    if (!std::ranges::all_of(seen, [f](const FeatureValues& values) { return values[f].has_value(); })) continue;
    if (fracture && discretisation_known && std::ranges::find(known, feature) == known.end()) continue;
    rows.push_back(added_.size());
    added_.rows.push_back({static_cast<int>(added_.groups.size()), feature, RowKind::mean, group.test,
                           1.0 / group.replicates, scatter_of(group, measured_)});
  }
  if (!rows.empty()) added_.groups.push_back(std::move(group));
  return rows;
}

/// A fracture test, simulated once, with slopes of its own, those of the same design as it was measured, or the mean
/// measured ones of layouts.
void PredictedTests::put_fracture(const FittedModel& model, FittedModel& predicted, int row, const FeatureValues& seen,
                                  const FractureSlopes* slopes) const {
  const DataRow& added = added_.rows[row];
  const pattern::Design& design = added_.group_of(row).design;
  predicted.predicted[row] = *value_of(seen, added.feature);
  if (slopes != nullptr) {
    predicted.jacobian.row(row) = slopes->by_coordinate.row(static_cast<Eigen::Index>(added.feature));
    return;
  }
  std::vector<int> own, all;
  for (int i = 0; i < measured_.size(); ++i) {
    const DataRow& each = measured_.rows[i];
    if (each.group < 0 || each.test != TestKind::toughness || each.feature != added.feature) continue;
    if (!is_notched_bulk(measured_.group_of(i))) all.push_back(i);
    if (measured_.group_of(i).design == design) own.push_back(i);
  }
  const std::vector<int>& like = own.empty() ? all : own;
  if (!like.empty()) predicted.jacobian.row(row) = model.jacobian(like, Eigen::all).colwise().mean();
}

/// How far constants of notched homogeneous specimens may lie from those of layouts, by the first explanation.
void PredictedTests::put_own_constants(const SlopesOfTests& slopes) {
  const int n = measured_.size();
  const Eigen::MatrixXd& known = measured_.bulk_constants;
  const bool has_known = known.rows() == n;
  if (!has_known && slopes.empty()) return;
  const Eigen::Index columns = has_known ? known.cols() : slopes.begin()->second.front().own_constants.cols();
  joined_.bulk_constants = Eigen::MatrixXd::Zero(joined_.size(), columns);
  if (has_known) joined_.bulk_constants.topRows(n) = known;
  for (std::size_t t = 0; t < rows_of_.size(); ++t) {
    for (const int row : rows_of_[t]) {
      const DataRow& added = added_.rows[row];
      if (slopes.contains(t))
        joined_.bulk_constants.row(n + row) =
            slopes.at(t).front().own_constants.row(static_cast<Eigen::Index>(added.feature));
      for (int i = 0; has_known && i < n; ++i)
        if (measured_.rows[i].group >= 0 && measured_.rows[i].test == added.test &&
            measured_.rows[i].feature == added.feature && measured_.group_of(i).design == added_.group_of(row).design)
          joined_.bulk_constants.row(n + row) = known.row(i);
    }
  }
}

/// The tests behind the measured rows, with their joint covariance.
void PredictedTests::join() {
  joined_ = measured_;
  const int groups = measured_.groups.size();
  joined_.groups.insert(joined_.groups.end(), added_.groups.begin(), added_.groups.end());
  for (DataRow row : added_.rows) {
    row.group += groups;
    joined_.rows.push_back(row);
  }
}

PredictedTests::Hypothesis PredictedTests::hypothesis_of(const Explanation& explanation, FittedModel added,
                                                         const NoiseRules& rules) const {
  const int n = measured_.size();
  Observations all = joined_;
  if (explanation.beside.are_of_specimens)
    for (int row = 0; row < added_.size(); ++row)
      if (first_of_[row] >= 0) all.groups[all.rows[n + row].group].machine = all.group_of(n + first_of_[row]).machine;
  const FittedModel& model = explanation.model;
  Hypothesis hypothesis{.measured = model,
                        .added = std::move(added),
                        .beside = explanation.beside,
                        .levels = free_directions(all, explanation.beside, rules),
                        .level_count = level_directions(all, explanation.beside.factors, rules.level_sd).cols(),
                        .whitener = Whitener(measured_.covariance()),
                        .predicted = {},
                        .columns = {},
                        .information = {}};
  const auto own = hypothesis.levels.topRows(n);
  if (own.cols() > 0) hypothesis.whitener = Whitener(measured_.covariance() + own * own.transpose());
  hypothesis.predicted.resize(joined_.size());
  hypothesis.predicted << model.predicted, hypothesis.added.predicted;
  if (own.cols() > 0)
    hypothesis.predicted += hypothesis.levels * (hypothesis.whitener(own).transpose() *
                                                 hypothesis.whitener(measured_.values - model.predicted));
  hypothesis.columns = model.whitened_columns(hypothesis.whitener);
  hypothesis.information = information(model, hypothesis.columns);
  return hypothesis;
}

PredictedTests::WrongModelRefit PredictedTests::refit(const Hypothesis& truth, const Hypothesis& wrong) const {
  WrongModelRefit refit;
  const Eigen::VectorXd shown = truth.predicted.head(measured_.size());
  linear_refit(wrong.measured, shown, wrong.whitener, &refit.step, sd_of_effects(wrong.measured));
  refit.left = wrong.whitener(shown - wrong.measured.predicted - wrong.measured.jacobian * refit.step);
  return refit;
}

double PredictedTests::covariance(int row, int other, const Hypothesis& hypothesis) const {
  const RowCovariance both = joined_.row_covariance(row, other);
  const bool shared = joined_.has_shared_discretisation();
  double covariance =
      both.fixed + both.scatter +
      (shared ? joined_.discretisation_shared.row(row).dot(joined_.discretisation_shared.row(other)) : 0.0);
  if (joined_.bulk_constants.rows() == joined_.size())
    covariance += joined_.bulk_constants.row(row).dot(joined_.bulk_constants.row(other));
  if (hypothesis.levels.cols() > 0) covariance += hypothesis.levels.row(row).dot(hypothesis.levels.row(other));
  return covariance;
}

PredictedTests::NewRow PredictedTests::new_row(int row, const Hypothesis& wrong) const {
  const int n = measured_.size(), place = n + row, first = first_of_[row] < 0 ? -1 : n + first_of_[row];
  Eigen::VectorXd with_measured(n);
  for (int i = 0; i < n; ++i) {
    with_measured[i] = covariance(place, i, wrong);
    if (first >= 0) with_measured[i] -= covariance(first, i, wrong);
  }
  NewRow result{row, first_of_[row], wrong.whitener(with_measured), 0.0};
  double variance = covariance(place, place, wrong);
  if (first >= 0) variance += covariance(first, first, wrong) - 2.0 * covariance(place, first, wrong);
  result.variance = variance - result.whitened.squaredNorm();
  if (is_of_unknown_stiffness(added_.group_of(row), measured_) && is_curve_stress(added_.rows[row].feature)) {
    // Its stiffness is fitted to either model: only the shape of the curve separates them.
    for (int i = 0; i < added_.size(); ++i) {
      const DataRow& other = added_.rows[i];
      const bool same = other.group == added_.rows[row].group;
      if (same && other.feature == Feature::log_tangent_30) result.against = i;
    }
  }
  return result;
}

bool PredictedTests::is_replicate(const NewRow& row, double variance, std::size_t a, std::size_t b) const {
  if (first_of_[row.row] >= 0) return false;
  const DataRow& added = added_.rows[row.row];
  const Eigen::VectorXd &by_a = hypotheses_[a].predicted, &by_b = hypotheses_[b].predicted;
  const int place = measured_.size() + row.row;
  const double apart = by_a[place] - by_b[place];
  for (int i = 0; i < measured_.size(); ++i) {
    const DataRow& other = measured_.rows[i];
    const bool twin = other.group >= 0 && other.test == added.test && other.feature == added.feature &&
                      measured_.group_of(i).design == added_.group_of(row.row).design;
    if (!twin) continue;
    if (std::abs(apart - (by_a[i] - by_b[i])) < same_errors_ * std::sqrt(variance)) return true;
  }
  return false;
}

double PredictedTests::growth(const NewRow& row, std::size_t truth, std::size_t wrong, double freer) const {
  const WrongModelRefit& refit = refits_[truth][wrong];
  const Hypothesis &right = hypotheses_[truth], &other = hypotheses_[wrong];
  const FittedModel& model = other.measured;
  const int n = measured_.size();
  double apart = right.predicted[n + row.row] - other.added.predicted[row.row];
  Eigen::RowVectorXd slopes = other.added.jacobian.row(row.row);
  if (row.against >= 0) {
    apart -= right.predicted[n + row.against] - other.added.predicted[row.against];
    slopes -= other.added.jacobian.row(row.against);
  }
  apart -= slopes.dot(refit.step) + row.whitened.dot(refit.left);
  // Uncertainty of the constants after the measured rows, as far as it moves this row against them.
  const Eigen::VectorXd open = slopes(model.free).transpose() - other.columns.topRows(n).transpose() * row.whitened;
  const double variance = row.variance + open.dot(other.information.solve(open));
  if (has_open_level(row.row, right)) return apart * apart / (variance + freer);
  return (apart * apart + freer) / variance;
}

bool PredictedTests::has_open_level(int row, const Hypothesis& hypothesis) const {
  const int n = measured_.size();
  for (Eigen::Index k = 0; k < hypothesis.level_count; ++k)
    if (hypothesis.levels(n + row, k) != 0.0 && hypothesis.levels.col(k).head(n).isZero()) return true;
  return false;
}

std::vector<Separation> PredictedTests::separations(
    std::size_t test, const std::vector<std::pair<std::size_t, std::size_t>>& pairs) const {
  std::vector<Separation> best(pairs.size());
  for (const int row : rows_of_[test]) {
    std::vector<NewRow> added;
    for (const Hypothesis& wrong : hypotheses_)
      added.push_back(!added.empty() && wrong.beside == hypotheses_.front().beside ? added.front()
                                                                                   : new_row(row, wrong));
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const auto [a, b] = pairs[p];
      const double freer = added[a].variance - added[b].variance,
                   least = std::min(added[a].variance, added[b].variance);
      if (std::abs(freer) < same_errors_ * least && is_replicate(added[a], least, a, b)) continue;
      const double of_b = growth(added[b], a, b, std::max(0.0, freer)),
                   of_a = growth(added[a], b, a, std::max(0.0, -freer));
      const double grown = holds(hypotheses_[a], hypotheses_[b])   ? of_b
                           : holds(hypotheses_[b], hypotheses_[a]) ? of_a
                                                                   : 0.5 * (of_a + of_b);
      const double apart = std::sqrt(grown);
      if (apart > best[p].errors) best[p] = {apart, added_.rows[row].feature};
    }
  }
  return best;
}

bool PredictedTests::holds(const Hypothesis& whole, const Hypothesis& part) {
  const std::vector<std::string>& effects = whole.measured.effects;
  return whole.beside == part.beside && std::ranges::all_of(part.measured.effects, [&](const std::string& effect) {
           return std::ranges::find(effects, effect) != effects.end();
         });
}

}  // namespace nacre::diagnosis
