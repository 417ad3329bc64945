#include "diagnosis/simulated_fracture.hpp"

#include <cmath>

#include "diagnosis/fracture_tests.hpp"
#include "measurement/reduction.hpp"
#include "sysid/eta.hpp"
#include "tester/strength_field.hpp"
#include "tester/toughness.hpp"

namespace nacre::diagnosis {
namespace {

/// By how much each searched constant of `b` is larger, log units.
Eigen::VectorXd log_changes(const material::ToughnessParameters& a, const material::ToughnessParameters& b) {
  const material::ToughnessVector from = to_vector(a), to = to_vector(b);
  Eigen::VectorXd changes(static_cast<Eigen::Index>(sysid::kSearchedEta.size()));
  for (Eigen::Index k = 0; k < changes.size(); ++k) {
    const double before = from[sysid::kSearchedEta[k]], after = to[sysid::kSearchedEta[k]];
    changes[k] = before > 0.0 && after > 0.0 ? std::log(after / before) : 0.0;
  }
  return changes;
}

}  // namespace

FeatureValues mean_fracture_features(const PossibleTest& test, const material::ParameterSet& set,
                                     const FractureSimulation& simulation) {
  const int specimens = tester::specimens_differ(set) ? simulation.specimens : 1;
  FeatureValues sum;
  for (int k = 0; k < specimens; ++k) {
    const auto result = tester::test_toughness(
        {test.design, simulated_side(set), test.conditions, simulation.fidelity, tester::kFirstPredictionSpecimen + k});
    if (!result) return {};
    sysid::Prediction prediction;
    prediction.toughness_pa = result->toughness_pa;
    prediction.curve = tester::resampled(measurement::forward_part(result->curve), simulation.reading.fracture_points);
    const FeatureValues own = shown_features(prediction, set.extensions, simulation.reading);
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

FractureSlopes fracture_slopes(const PossibleTest& test, const CoordinateMap& map, const Eigen::VectorXd& u,
                               double constant_sd, const FractureSimulation& simulation) {
  constexpr double kStep = 0.02;
  FractureSlopes slopes{Eigen::MatrixXd::Zero(kFeatureCount, u.size()),
                        Eigen::MatrixXd::Zero(kFeatureCount, static_cast<Eigen::Index>(sysid::kSearchedEta.size()))};
  const material::ParameterSet set = map.parameters(u);
  const FeatureValues plain = mean_fracture_features(test, set, simulation);
  for (Eigen::Index j = 0; j < u.size(); ++j) {
    Eigen::VectorXd moved = u;
    moved[j] += moved[j] + kStep <= map.upper(static_cast<int>(j)) ? kStep : -kStep;
    const material::ParameterSet other = map.parameters(moved);
    const Eigen::VectorXd moved_constants = log_changes(set.toughness, other.toughness);
    if (moved_constants.isZero() && set.extensions == other.extensions) continue;
    const FeatureValues values = mean_fracture_features(test, other, simulation);
    for (std::size_t f = 0; f < kFeatureCount; ++f) {
      if (!plain[f] || !values[f]) continue;
      const double change = *values[f] - *plain[f];
      const auto row = static_cast<Eigen::Index>(f);
      slopes.by_coordinate(row, j) = change / (moved[j] - u[j]);
      for (Eigen::Index k = 0; k < moved_constants.size(); ++k)
        if (moved_constants[k] != 0.0) slopes.own_constants(row, k) = change * constant_sd / moved_constants[k];
    }
  }
  return slopes;
}

}  // namespace nacre::diagnosis
