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
  double coarse_toughness = 0.0, fine_toughness = 0.0;
  FeatureVector change;  ///< feature(h/2) - feature(h)
};

std::vector<MeshPair> finished_pairs(const FloorPlan& plan, const study::StudyTable& table, const ModulusFloor& moduli,
                                     int& failed) {
  std::vector<MeshPair> pairs;
  for (std::size_t i = 0; i < plan.layouts.size(); ++i)
    for (std::size_t s = 0; s < plan.sets.size(); ++s) {
      const auto coarse = table.find(toughness_key(plan, i, s, 1)), fine = table.find(toughness_key(plan, i, s, 2));
      if (!coarse || !fine) continue;
      if ((*coarse)[0] <= 0.0 || (*fine)[0] <= 0.0) {
        ++failed;
        continue;
      }
      MeshPair pair{
          .layout = i, .set = s, .coarse_toughness = (*coarse)[0], .fine_toughness = (*fine)[0], .change = {}};
      pair.z = (plan.layouts[i].rigid_fraction() - kMiddleFraction) / kFractionUnit;
      pair.change[0] = moduli.residuals[s][i];  // refitted already
      for (int f = 1; f < kFeatures; ++f) pair.change[f] = std::log((*fine)[f - 1] / (*coarse)[f - 1]);
      pairs.push_back(pair);
    }
  return pairs;
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
  if (floor.repeated > 0) floor.same_layout = products / floor.repeated / variance;
}

}  // namespace

ToughnessFloor toughness_floor(const FloorPlan& plan, const study::StudyTable& table, const ModulusFloor& moduli) {
  ToughnessFloor floor;
  const std::vector<MeshPair> pairs = finished_pairs(plan, table, moduli, floor.failed);
  floor.pairs = static_cast<int>(pairs.size());
  floor.mean.setZero(), floor.shared.setZero(), floor.rigid.setZero(), floor.layout.setZero();
  std::map<std::size_t, std::vector<MeshPair>> by_set;
  std::set<std::size_t> layouts;
  for (const MeshPair& pair : pairs) {
    by_set[pair.set].push_back(pair);
    layouts.insert(pair.layout);
    floor.mean += pair.change / floor.pairs;
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
  floor.layout /= slope_freedom;
  floor.sd = (squares / freedom).cwiseSqrt();
  for (std::size_t k = 0; k < 2; ++k) floor.at_sd[k] = residuals[k].empty() ? 0.0 : root_mean_square(residuals[k]);
  correlate_layouts(residuals_of_layout, floor.layout(1, 1), floor);
  return floor;
}

std::string to_toml(const ToughnessFloor& floor) {
  if (floor.sets == 0) return "";
  std::string text = fmt::format("toughness_layouts = {}\ntoughness_parameter_sets = {}\ntoughness_pairs = {}\n",
                                 floor.layouts, floor.sets, floor.pairs);
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
