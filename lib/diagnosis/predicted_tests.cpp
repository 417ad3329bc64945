#include "diagnosis/predicted_tests.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "diagnosis/shared_discretisation.hpp"
#include "measurement/reduction.hpp"
#include "tester/modulus.hpp"
#include "tester/strength_field.hpp"
#include "tester/toughness.hpp"

namespace nacre::diagnosis {
namespace {

using tester::TestKind;

/// The curve of a homogeneous coupon that is unloaded on its way; empty when it cannot be pulled so.
tester::Curve coupon_curve(const PossibleTest& test, const material::ParameterSet& set, tester::Fidelity fidelity) {
  auto curve = coupon_through_machine({test.design, set, test.conditions, fidelity}, unload_history());
  return curve ? *std::move(curve) : tester::Curve{};
}

material::ParameterSet parameters_for(const PossibleTest& test, const CoordinateMap& map, const Eigen::VectorXd& u) {
  return test.design.layout() ? map.parameters(u) : map.coupon_parameters(u);
}

/// Means over specimens that every model breaks alike, of the features that all show: one crack would differ from model
/// to model by chance.
FeatureValues mean_fracture_features(const PossibleTest& test, const material::ParameterSet& set,
                                     tester::Fidelity fidelity, const CurveReading& reading, int specimens) {
  if (!tester::specimens_differ(set)) specimens = 1;
  FeatureValues sum;
  for (int k = 0; k < specimens; ++k) {
    const auto result = tester::test_toughness(
        {test.design, simulated_side(set), test.conditions, fidelity, tester::kFirstPredictionSpecimen + k});
    if (!result) return {};
    sysid::Prediction prediction;
    prediction.toughness_pa = result->toughness_pa;
    prediction.curve = tester::resampled(measurement::forward_part(result->curve), reading.fracture_points);
    const FeatureValues own = shown_features(prediction, set.extensions, reading);
    for (std::size_t f = 0; f < kFeatureCount; ++f) {
      if (k > 0 && !sum[f]) continue;
      if (own[f])
        sum[f] = sum[f].value_or(0.0) + *own[f] / specimens;
      else
        sum[f].reset();
    }
  }
  return sum;
}

/// Predictions of a test by a model, one value per feature that it shows.
FeatureValues predicted_features(const PossibleTest& test, const material::ParameterSet& set, tester::Fidelity fidelity,
                                 const CurveReading& reading, int specimens) {
  FeatureValues values;
  if (test.test == TestKind::modulus) {
    if (const auto result = tester::test_modulus({test.design, simulated_side(set), test.conditions, fidelity}))
      value_of(values, Feature::log_modulus) =
          std::log(measurement::observe_modulus(result->modulus_pa, set.extensions));
  } else if (test.test == TestKind::tensile) {
    const tester::Curve curve = coupon_curve(test, set, fidelity);
    if (!curve.empty()) values = tensile_features(curve, reading);
  } else {
    values = mean_fracture_features(test, set, fidelity, reading, specimens);
  }
  return values;
}

/// By test and model.
std::vector<std::vector<FeatureValues>> predictions(const std::vector<PossibleTest>& tests,
                                                    const std::vector<FittedModel>& models, const FeatureModel& model,
                                                    tester::Fidelity fidelity, const CurveReading& reading,
                                                    int specimens) {
  std::vector<std::vector<FeatureValues>> seen(tests.size(), std::vector<FeatureValues>(models.size()));
  parallel_for(tests.size() * models.size(), [&](int job) {
    const std::size_t t = static_cast<std::size_t>(job) / models.size(),
                      m = static_cast<std::size_t>(job) % models.size();
    const CoordinateMap map = model.map(models[m].effects);
    seen[t][m] = predicted_features(tests[t], parameters_for(tests[t], map, models[m].u), fidelity, reading, specimens);
  });
  return seen;
}

/// Whether E of a homogeneous coupon's material is unknown: none of it has been pulled.
bool is_of_unknown_stiffness(const Observation& added, const Observations& measured) {
  return added.design.mixture() != nullptr &&
         std::ranges::none_of(measured.groups, [&](const Observation& g) { return g.design == added.design; });
}

/// Whether a model is another one with something added.
bool holds(const FittedModel& whole, const FittedModel& part) {
  return std::ranges::all_of(part.effects, [&](const std::string& effect) {
    return std::ranges::find(whole.effects, effect) != whole.effects.end();
  });
}

/// The inverse of the covariance of a model's free coordinates: information of the data, prior of the base constants,
/// and for an effect a uniform prior over its range. `columns`: FittedModel::whitened_columns().
Eigen::LDLT<Eigen::MatrixXd> information(const FittedModel& model, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd normal = columns.transpose() * columns;
  for (std::size_t k = 0; k < model.free.size(); ++k) {
    const int i = model.free[k];
    if (i < model.base_count) continue;
    const double width = model.upper[i] - model.lower[i];
    normal.diagonal()[k] += 12.0 / (width * width);
  }
  return normal.ldlt();
}

}  // namespace

PredictedTests::PredictedTests(const Evidence& evidence, std::vector<FittedModel> models,
                               const std::vector<PossibleTest>& tests, int replicates)
    : measured_(evidence.observations), models_(std::move(models)), whitener_(measured_.covariance()) {
  const tester::Fidelity fidelity = evidence.settings.fidelity;
  const auto seen = predictions(tests, models_, evidence.model, fidelity, measured_.reading,
                                evidence.settings.procedure.tests.broken_specimens);
  added_.reading = measured_.reading;
  added_.constant_sd = measured_.constant_sd;
  same_errors_ = evidence.settings.procedure.tests.same_errors;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    Observation group = group_of(tests[t], replicates);
    if (group.test == TestKind::tensile) {
      const CoordinateMap map = evidence.model.map(models_.front().effects);
      group.curve = coupon_curve(tests[t], parameters_for(tests[t], map, models_.front().u), fidelity);
    }
    rows_of_.push_back(add_group(std::move(group), seen[t]));
  }
  const FeatureModel bench(added_, evidence.model.basis(), fidelity);
  for (std::size_t m = 0; m < models_.size(); ++m) {
    predicted_.push_back(linearised(bench, models_[m].effects, models_[m].u));
    for (std::size_t t = 0; t < tests.size(); ++t)
      for (const int row : rows_of_[t])
        if (tests[t].test == TestKind::toughness) put_fracture(m, row, seen[t][m]);
    columns_.push_back(models_[m].whitened_columns(whitener_));
    information_.push_back(information(models_[m], columns_.back()));
  }
  join();
  if (measured_.has_shared_discretisation()) {
    joined_.discretisation_shared.conservativeResize(joined_.size(), Eigen::NoChange);
    joined_.discretisation_shared.bottomRows(added_.size()) = shared_directions(evidence, bench);
  }
  refits_.resize(models_.size());
  for (std::size_t truth = 0; truth < models_.size(); ++truth)
    for (const FittedModel& wrong : models_) refits_[truth].push_back(refit(models_[truth], wrong));
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
                           1.0 / group.replicates, static_cast<std::size_t>(group.test)});
  }
  if (!rows.empty()) added_.groups.push_back(std::move(group));
  return rows;
}

/// A fracture test, simulated once, with the slopes of the same layout as it was measured, or the mean measured ones.
void PredictedTests::put_fracture(std::size_t model, int row, const FeatureValues& seen) {
  const DataRow& added = added_.rows[row];
  const pattern::Design& design = added_.group_of(row).design;
  FittedModel& predicted = predicted_[model];
  predicted.predicted[row] = *value_of(seen, added.feature);
  std::vector<int> own, all;
  for (int i = 0; i < measured_.size(); ++i) {
    const DataRow& each = measured_.rows[i];
    if (each.group < 0 || each.test != TestKind::toughness || each.feature != added.feature) continue;
    all.push_back(i);
    if (measured_.group_of(i).design == design) own.push_back(i);
  }
  const std::vector<int>& like = own.empty() ? all : own;
  if (!like.empty()) predicted.jacobian.row(row) = models_[model].jacobian(like, Eigen::all).colwise().mean();
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

PredictedTests::WrongModelRefit PredictedTests::refit(const FittedModel& truth, const FittedModel& wrong) const {
  WrongModelRefit refit;
  linear_refit(wrong, truth.predicted, whitener_, &refit.step);
  refit.left = whitener_(truth.predicted - wrong.predicted - wrong.jacobian * refit.step);
  return refit;
}

PredictedTests::NewRow PredictedTests::new_row(int row) const {
  const int n = measured_.size(), place = n + row;
  const auto covariance = [&](int i) {
    const RowCovariance both = joined_.row_covariance(place, i);
    const bool shared = joined_.has_shared_discretisation();
    return both.fixed + both.scatter +
           (shared ? joined_.discretisation_shared.row(place).dot(joined_.discretisation_shared.row(i)) : 0.0);
  };
  Eigen::VectorXd with_measured(n);
  for (int i = 0; i < n; ++i) with_measured[i] = covariance(i);
  NewRow result{row, -1, whitener_(with_measured), 0.0};
  result.variance = covariance(place) - result.whitened.squaredNorm();
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

bool PredictedTests::is_replicate(const NewRow& row, std::size_t a, std::size_t b) const {
  const DataRow& added = added_.rows[row.row];
  const double apart = predicted_[a].predicted[row.row] - predicted_[b].predicted[row.row];
  for (int i = 0; i < measured_.size(); ++i) {
    const DataRow& other = measured_.rows[i];
    const bool twin = other.group >= 0 && other.test == added.test && other.feature == added.feature &&
                      measured_.group_of(i).design == added_.group_of(row.row).design;
    if (!twin) continue;
    const double measured_apart = models_[a].predicted[i] - models_[b].predicted[i];
    if (std::abs(apart - measured_apart) < same_errors_ * std::sqrt(row.variance)) return true;
  }
  return false;
}

double PredictedTests::growth(const NewRow& row, std::size_t truth, std::size_t wrong) const {
  const WrongModelRefit& refit = refits_[truth][wrong];
  const FittedModel& model = models_[wrong];
  double apart = predicted_[truth].predicted[row.row] - predicted_[wrong].predicted[row.row];
  Eigen::RowVectorXd slopes = predicted_[wrong].jacobian.row(row.row);
  if (row.against >= 0) {
    apart -= predicted_[truth].predicted[row.against] - predicted_[wrong].predicted[row.against];
    slopes -= predicted_[wrong].jacobian.row(row.against);
  }
  apart -= slopes.dot(refit.step) + row.whitened.dot(refit.left);
  // Uncertainty of the constants after the measured rows, as far as it moves this row against them.
  const Eigen::VectorXd open =
      slopes(model.free).transpose() - columns_[wrong].topRows(measured_.size()).transpose() * row.whitened;
  const double variance = row.variance + open.dot(information_[wrong].solve(open));
  return apart * apart / variance;
}

std::vector<Separation> PredictedTests::separations(
    std::size_t test, const std::vector<std::pair<std::size_t, std::size_t>>& pairs) const {
  std::vector<Separation> best(pairs.size());
  for (const int row : rows_of_[test]) {
    const NewRow added = new_row(row);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const auto [a, b] = pairs[p];
      if (is_replicate(added, a, b)) continue;
      const double of_b = growth(added, a, b), of_a = growth(added, b, a);
      const double grown = holds(models_[a], models_[b])   ? of_b
                           : holds(models_[b], models_[a]) ? of_a
                                                           : 0.5 * (of_a + of_b);
      const double apart = std::sqrt(grown);
      if (apart > best[p].errors) best[p] = {apart, added_.rows[row].feature};
    }
  }
  return best;
}

}  // namespace nacre::diagnosis
