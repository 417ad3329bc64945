#include "toughness_floor.hpp"

#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "base/statistics.hpp"

namespace nacre::discretisation_floor {
namespace {

constexpr std::size_t kLeastPairs = 4;  // of a parameter set that is used
constexpr double kMiddleFraction = 0.675, kFractionUnit = 0.1;

/// One layout with one parameter set on both meshes.
struct MeshPair {
  std::size_t layout = 0, set = 0;
  double z = 0.0;
  double coarse_toughness = 0.0, fine_toughness = 0.0;  ///< means over specimens, Pa
  FeatureVector change;                                 ///< feature(h/2) - feature(h), mean over specimens
  FeatureMatrix of_finite_n = FeatureMatrix::Zero();    ///< covariance of that mean
};

/// Log T, log peak and log failure strain, fine less coarse, of every specimen up to the first that failed; T of both.
struct SpecimenChanges {
  std::vector<FeatureVector> changes;
  std::vector<double> coarse_pa, fine_pa;
};

SpecimenChanges changes_of(const FloorPlan& plan, const study::StudyTable& table, std::size_t layout, std::size_t set) {
  SpecimenChanges result;
  for (int specimen = 0; specimen < plan.specimens; ++specimen) {
    const auto coarse = table.find(toughness_key(plan, layout, set, 1, specimen)),
               fine = table.find(toughness_key(plan, layout, set, 2, specimen));
    if (!coarse || !fine || (*coarse)[0] <= 0.0 || (*fine)[0] <= 0.0) break;
    FeatureVector change = FeatureVector::Zero();
    for (int f = 1; f < kFeatures; ++f) change[f] = std::log((*fine)[f - 1] / (*coarse)[f - 1]);
    result.changes.push_back(change);
    result.coarse_pa.push_back((*coarse)[0]);
    result.fine_pa.push_back((*fine)[0]);
  }
  return result;
}

/// Of the mean of these; zero of fewer than two.
FeatureMatrix covariance_of_mean(const std::vector<FeatureVector>& changes, const FeatureVector& middle) {
  FeatureMatrix covariance = FeatureMatrix::Zero();
  const auto n = static_cast<double>(changes.size());
  if (changes.size() < 2) return covariance;
  for (const FeatureVector& change : changes) covariance += (change - middle) * (change - middle).transpose();
  return covariance / (n - 1.0) / n;
}

/// Designs with at least two specimens on both meshes (one where one is planned).
std::vector<MeshPair> finished_pairs(const FloorPlan& plan, const study::StudyTable& table, const ModulusFloor& moduli,
                                     int& failed) {
  std::vector<MeshPair> pairs;
  for (std::size_t i = 0; i < plan.layouts.size(); ++i)
    for (std::size_t s = 0; s < plan.sets.size(); ++s) {
      const SpecimenChanges own = changes_of(plan, table, i, s);
      const bool is_begun = table.find(toughness_key(plan, i, s, 2, 0)).has_value();
      if (static_cast<int>(own.changes.size()) < std::min(2, plan.specimens)) {
        failed += is_begun ? 1 : 0;
        continue;
      }
      MeshPair pair{
          .layout = i, .set = s, .coarse_toughness = mean(own.coarse_pa), .fine_toughness = mean(own.fine_pa)};
      pair.z = (plan.layouts[i].rigid_fraction() - kMiddleFraction) / kFractionUnit;
      pair.change = FeatureVector::Zero();
      for (const FeatureVector& change : own.changes) pair.change += change / static_cast<double>(own.changes.size());
      pair.of_finite_n = covariance_of_mean(own.changes, pair.change);
      pair.change[0] = moduli.residuals[s][i];  // refitted already
      pairs.push_back(pair);
    }
  return pairs;
}

/// The nearest covariance without negative variances in any direction.
FeatureMatrix without_negative_variances(const FeatureMatrix& matrix) {
  const Eigen::SelfAdjointEigenSolver<FeatureMatrix> solver(matrix);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).asDiagonal() * solver.eigenvectors().transpose();
}

/// The part of a mean change of (log T, log peak, log strain) that scales of all E and of all W cannot fit: that across
/// their two directions (0, 1/2, -1/2) and (1, 1/2, 1/2).
FeatureVector residual_of_scales(const FeatureVector& mean_change) {
  const Eigen::Vector3d across = Eigen::Vector3d(1.0, -1.0, -1.0).normalized();
  FeatureVector residual = FeatureVector::Zero();
  residual[0] = mean_change[0];
  residual.tail<3>() = across * across.dot(mean_change.tail<3>());
  return residual;
}

/// Intercept and slope in z of the changes of one parameter set.
struct TrendLine {
  FeatureVector middle = FeatureVector::Zero(), slope = FeatureVector::Zero();
};

TrendLine line_of(const std::vector<MeshPair>& pairs) {
  double n = 0.0, z1 = 0.0, z2 = 0.0;
  FeatureVector sum = FeatureVector::Zero(), sum_z = FeatureVector::Zero();
  for (const MeshPair& pair : pairs) {
    n += 1.0, z1 += pair.z, z2 += pair.z * pair.z;
    sum += pair.change;
    sum_z += pair.z * pair.change;
  }
  const double determinant = n * z2 - z1 * z1;
  return {.middle = (z2 * sum - z1 * sum_z) / determinant, .slope = (n * sum_z - z1 * sum) / determinant};
}

std::string matrix_text(const FeatureMatrix& matrix) {
  std::string text = "[";
  for (int row = 0; row < kFeatures; ++row) {
    text += row == 0 ? "[" : ", [";
    for (int column = 0; column < kFeatures; ++column)
      text += fmt::format("{}{:.3e}", column == 0 ? "" : ", ", matrix(row, column));
    text += "]";
  }
  return text + "]";
}

/// Correlation of log T between parameter sets of the same layout: mean product of the residuals over their mean
/// square.
void correlate_layouts(const std::map<std::size_t, std::vector<double>>& residuals, double variance,
                       ToughnessFloor& floor) {
  double products = 0.0;
  for (const auto& [layout, values] : residuals)
    for (std::size_t a = 0; a < values.size(); ++a)
      for (std::size_t b = a + 1; b < values.size(); ++b) products += values[a] * values[b], ++floor.repeated;
  if (floor.repeated > 0 && variance > 0.0) floor.same_layout = products / floor.repeated / variance;
}

}  // namespace

ToughnessFloor toughness_floor(const FloorPlan& plan, const study::StudyTable& table, const ModulusFloor& moduli) {
  ToughnessFloor floor;
  const std::vector<MeshPair> pairs = finished_pairs(plan, table, moduli, floor.failed);
  floor.pairs = static_cast<int>(pairs.size());
  floor.of_finite_n.setZero(), floor.mean.setZero(), floor.shared.setZero(), floor.rigid.setZero(),
      floor.layout.setZero();
  std::map<std::size_t, std::vector<MeshPair>> by_set;
  std::set<std::size_t> layouts;
  for (const MeshPair& pair : pairs) {
    by_set[pair.set].push_back(pair);
    layouts.insert(pair.layout);
    floor.mean += pair.change / floor.pairs;
    floor.of_finite_n += pair.of_finite_n / floor.pairs;
  }
  floor.layouts = static_cast<int>(layouts.size());
  std::map<std::size_t, std::vector<double>> residuals_of_layout;
  std::vector<double> residuals[2];
  FeatureVector squares = FeatureVector::Zero();
  double freedom = 0.0, slope_freedom = 0.0;
  for (const auto& [set, own] : by_set) {
    if (own.size() < kLeastPairs) continue;
    ++floor.sets;
    const TrendLine line = line_of(own);
    FeatureVector middle = FeatureVector::Zero();
    std::vector<double> coarse, fine;
    for (const MeshPair& pair : own) {
      middle += pair.change / static_cast<double>(own.size());
      coarse.push_back(pair.coarse_toughness);
      fine.push_back(pair.fine_toughness);
    }
    const FeatureVector shared = residual_of_scales(middle);
    floor.shared += shared * shared.transpose();
    floor.rigid += line.slope * line.slope.transpose();
    floor.spearman += rank_correlation(coarse, fine);
    for (const MeshPair& pair : own) {
      squares += (pair.change - middle).cwiseAbs2();
      const FeatureVector residual = pair.change - line.middle - pair.z * line.slope;
      floor.layout += residual * residual.transpose();
      residuals_of_layout[pair.layout].push_back(residual[1]);
      residuals[plan.layouts[pair.layout].rigid_fraction() >= kManyRigid ? 1 : 0].push_back(residual[1]);
    }
    freedom += static_cast<double>(own.size()) - 1.0;
    slope_freedom += static_cast<double>(own.size()) - 2.0;
  }
  if (floor.sets == 0) return floor;
  floor.shared /= floor.sets, floor.rigid /= floor.sets, floor.spearman /= floor.sets;
  floor.layout = without_negative_variances(floor.layout / slope_freedom - floor.of_finite_n);
  floor.sd = (squares / freedom - floor.of_finite_n.diagonal()).cwiseMax(0.0).cwiseSqrt();
  for (std::size_t k = 0; k < 2; ++k) floor.at_sd[k] = residuals[k].empty() ? 0.0 : root_mean_square(residuals[k]);
  correlate_layouts(residuals_of_layout, floor.layout(1, 1), floor);
  return floor;
}

std::string to_toml(const ToughnessFloor& floor) {
  if (floor.sets == 0) return "";
  std::string text = fmt::format(
      "toughness_layouts = {}\ntoughness_parameter_sets = {}\ntoughness_pairs = {}\n"
      "# Of means over specimens, less what their finite number makes (log T {:.4f}).\n",
      floor.layouts, floor.sets, floor.pairs, std::sqrt(floor.of_finite_n(1, 1)));
  for (int f = 1; f < kFeatures; ++f)
    text += fmt::format("{}_mean = {:.4f}\n{}_sd = {:.5f}  # after one common factor per parameter set\n",
                        kFeatureNames[f], floor.mean[f], kFeatureNames[f], floor.sd[f]);
  text += fmt::format(
      "# log T below 75 % rigid {:.3f}, from there {:.3f}; same layout, other parameters: correlation {:.2f} ({} "
      "pairs)\n",
      floor.at_sd[0], floor.at_sd[1], floor.same_layout, floor.repeated);
  text += fmt::format("toughness_spearman = {:.3f}\n", floor.spearman);
  text +=
      "# Covariance between features (of layouts i and j; z = (rigid fraction - 0.675) / 0.1) after a refit:\n"
      "# shared + z_i z_j rigid + (i = j) layout.\n"
      "features = [\"log_modulus\", \"log_toughness\", \"log_peak\", \"log_failure_strain\"]\n";
  text += "covariance_shared = " + matrix_text(floor.shared) + "\ncovariance_rigid = " + matrix_text(floor.rigid) +
          "\ncovariance_layout = " + matrix_text(floor.layout) + "\n";
  return text;
}

}  // namespace nacre::discretisation_floor
