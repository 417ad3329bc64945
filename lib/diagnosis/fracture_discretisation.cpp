#include "diagnosis/fracture_discretisation.hpp"

#include <algorithm>
#include <cmath>

#include "base/square.hpp"
#include "base/toml_file.hpp"

namespace nacre::diagnosis {
namespace {

Eigen::MatrixXd matrix(const toml::table& table, const char* key, std::size_t size, const std::string& place) {
  const toml::array* rows = table[key].as_array();
  if (rows == nullptr || rows->size() != size) throw InputError::format("{} {}: expected {} rows", place, key, size);
  Eigen::MatrixXd result(size, size);
  for (std::size_t i = 0; i < size; ++i) {
    const toml::array* row = rows->get(i)->as_array();
    if (row == nullptr || row->size() != size)
      throw InputError::format("{} {}: expected {} numbers in row {}", place, key, size, i + 1);
    for (std::size_t j = 0; j < size; ++j) {
      const auto value = row->get(j)->value<double>();
      if (!value) throw InputError::format("{} {}: expected numbers in row {}", place, key, i + 1);
      result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = *value;
    }
  }
  return result;
}

/// Sums over few parameter sets have directions without any variance, which four printed digits may turn into slightly
/// negative ones; spread over all layouts these outweigh the scatter. They are set to zero; a matrix that is no
/// covariance at all is an error.
Eigen::MatrixXd as_covariance(const Eigen::MatrixXd& given, const char* key, const std::string& place) {
  constexpr double kRounding = 1e-3;
  if (!given.isApprox(given.transpose(), 1e-6) || given.diagonal().minCoeff() <= 0.0)
    throw InputError::format("{} {}: expected a symmetric matrix with positive variances", place, key);
  const Eigen::VectorXd deviation = given.diagonal().cwiseSqrt(), inverse = deviation.cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(inverse.asDiagonal() * given * inverse.asDiagonal());
  if (parts.eigenvalues().minCoeff() < -kRounding * parts.eigenvalues().maxCoeff())
    throw InputError::format("{} {}: no covariance: some combination of features has a negative variance", place, key);
  const Eigen::MatrixXd correlation =
      parts.eigenvectors() * parts.eigenvalues().cwiseMax(0.0).asDiagonal() * parts.eigenvectors().transpose();
  return deviation.asDiagonal() * correlation * deviation.asDiagonal();
}

constexpr int kFitted = 2;           ///< to changes over layouts: a level and a slope over the rigid fraction
constexpr double kLeastShare = 0.1;  ///< of a variance that stays when scatter comes off

/// Features that every specimen of every layout shows on both meshes.
std::vector<Feature> shown_by_all(const std::vector<RefinedLayout>& layouts) {
  std::vector<Feature> features;
  for (std::size_t f = 0; f < kFeatureCount; ++f) {
    const auto shows = [f](const FeatureValues& values) { return values[f].has_value(); };
    if (std::ranges::all_of(layouts, [&](const RefinedLayout& layout) {
          return std::ranges::all_of(layout.coarse, shows) && std::ranges::all_of(layout.fine, shows);
        }))
      features.push_back(static_cast<Feature>(f));
  }
  return features;
}

/// Changes of features with finer elements.
struct LayoutChanges {
  Eigen::MatrixXd means;      ///< layouts x features, over specimens
  Eigen::VectorXd positions;  ///< z of each layout
  Eigen::MatrixXd of_mean;    ///< covariance of such a mean by the scatter of specimens
};

LayoutChanges changes_of(const std::vector<RefinedLayout>& layouts, const std::vector<Feature>& features) {
  const auto n = static_cast<Eigen::Index>(layouts.size()), count = static_cast<Eigen::Index>(features.size());
  LayoutChanges changes{Eigen::MatrixXd(n, count), Eigen::VectorXd(n), Eigen::MatrixXd::Zero(count, count)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const RefinedLayout& layout = layouts[i];
    const auto specimens = static_cast<Eigen::Index>(layout.coarse.size());
    Eigen::MatrixXd own(specimens, count);
    for (Eigen::Index s = 0; s < specimens; ++s)
      for (Eigen::Index f = 0; f < count; ++f)
        own(s, f) = *value_of(layout.fine[s], features[f]) - *value_of(layout.coarse[s], features[f]);
    changes.positions[i] = rigid_position(layout.design);
    changes.means.row(i) = own.colwise().mean();
    const Eigen::MatrixXd about = own.rowwise() - changes.means.row(i);
    changes.of_mean += about.transpose() * about / (std::max<double>(specimens - 1, 1) * specimens * n);
  }
  return changes;
}

/// What a line over the positions leaves.
Eigen::MatrixXd off_level_and_slope(const Eigen::MatrixXd& means, const Eigen::VectorXd& positions) {
  Eigen::MatrixXd line(positions.size(), kFitted);
  line << Eigen::VectorXd::Ones(positions.size()), positions;
  return means - line * line.colPivHouseholderQr().solve(means);
}

Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd inverse = covariance.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  return inverse.asDiagonal() * covariance * inverse.asDiagonal();
}

/// Of layouts that no table tells of: what they have in common.
FractureDiscretisation shared_only(const LayoutChanges& changes, const std::vector<Feature>& features) {
  const auto count = static_cast<Eigen::Index>(features.size());
  const Eigen::RowVectorXd level = changes.means.colwise().mean();
  return {.features = features,
          .shared = level.transpose() * level,
          .rigid = Eigen::MatrixXd::Zero(count, count),
          .layout = Eigen::MatrixXd::Zero(count, count)};
}

}  // namespace

std::optional<double> RefinedLayout::change(Feature feature) const {
  double sum = 0.0;
  for (std::size_t s = 0; s < coarse.size(); ++s) {
    const auto &before = value_of(coarse[s], feature), &after = value_of(fine[s], feature);
    if (!before || !after) return std::nullopt;
    sum += *after - *before;
  }
  return sum / static_cast<double>(coarse.size());
}

double rigid_position(const pattern::Design& design) { return (design.rigid_fraction() - 0.675) / 0.1; }

FractureDiscretisation at_own_constants(const FractureDiscretisation& table, const std::vector<RefinedLayout>& layouts,
                                        const EmulatorRules& rules) {
  const int dof = static_cast<int>(layouts.size()) - kFitted;
  const std::vector<Feature> features = shown_by_all(layouts);
  if (dof < 1 || features.empty()) return table;
  const LayoutChanges changes = changes_of(layouts, features);
  const Eigen::MatrixXd left = off_level_and_slope(changes.means, changes.positions);
  const Eigen::MatrixXd raw = left.transpose() * left / dof;
  // What is left when the scatter of few specimens comes off may be nothing.
  const Eigen::VectorXd own = (raw - changes.of_mean).diagonal().cwiseMax(kLeastShare * raw.diagonal());
  FractureDiscretisation at_constants = table.features.empty() ? shared_only(changes, features) : table;
  const double share = square(rules.floor_log_sd) / (square(rules.floor_log_sd) + 2.0 / dof);
  std::vector<Eigen::Index> place;  // in the table, of the features that both have
  std::vector<Eigen::Index> told;
  for (std::size_t f = 0; f < features.size(); ++f) {
    const auto found = std::ranges::find(at_constants.features, features[f]);
    if (found == at_constants.features.end()) continue;
    place.push_back(found - at_constants.features.begin());
    told.push_back(static_cast<Eigen::Index>(f));
  }
  const Eigen::MatrixXd known = at_constants.layout(place, place);
  const bool is_known = !table.features.empty();
  Eigen::VectorXd deviation = own(told).cwiseSqrt();
  Eigen::MatrixXd correlation = correlation_of(raw(told, told));
  if (is_known) {
    deviation = (known.diagonal().array().pow(1.0 - share) * own(told).array().pow(share)).sqrt();
    correlation = (dof * correlation + rules.floor_worth * correlation_of(known)) / (dof + rules.floor_worth);
  }
  at_constants.layout(place, Eigen::all).setZero();
  at_constants.layout(Eigen::all, place).setZero();
  at_constants.layout(place, place) = deviation.asDiagonal() * correlation * deviation.asDiagonal();
  return at_constants;
}

double FractureDiscretisation::covariance(Feature a, Feature b, double z_a, double z_b, bool same_layout) const {
  const auto i = std::find(features.begin(), features.end(), a), j = std::find(features.begin(), features.end(), b);
  if (i == features.end() || j == features.end()) return 0.0;
  const Eigen::Index r = i - features.begin(), c = j - features.begin();
  return shared(r, c) + z_a * z_b * rigid(r, c) + (same_layout ? layout(r, c) : 0.0);
}

FractureDiscretisation fracture_discretisation_from(std::string_view toml, std::string_view source,
                                                    tester::Fidelity fidelity) {
  const toml::table document = read_toml(toml, source);
  FractureDiscretisation floor;
  const toml::table* table = document[tester::to_string(fidelity)]["curve"].as_table();
  if (table == nullptr) return floor;
  const std::string place = fmt::format("{}: [{}.curve]", source, tester::to_string(fidelity));
  const toml::array* names = (*table)["features"].as_array();
  if (names == nullptr) throw InputError::format("{}: expected features, an array of names", place);
  for (const toml::node& node : *names) {
    const auto feature = feature_from_string(node.value_or(std::string_view{}));
    if (!feature) throw InputError::format("{} features: {}", place, feature.error().message);
    floor.features.push_back(*feature);
  }
  floor.shared = as_covariance(matrix(*table, "covariance_shared", names->size(), place), "covariance_shared", place);
  floor.rigid = as_covariance(matrix(*table, "covariance_rigid", names->size(), place), "covariance_rigid", place);
  floor.layout = as_covariance(matrix(*table, "covariance_layout", names->size(), place), "covariance_layout", place);
  return floor;
}

FractureDiscretisation read_fracture_discretisation(const std::filesystem::path& file, tester::Fidelity fidelity) {
  return fracture_discretisation_from(read_file(file), file.string(), fidelity);
}

}  // namespace nacre::diagnosis
