#include "diagnosis/fracture_discretisation.hpp"

#include <algorithm>

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

}  // namespace

double FractureDiscretisation::covariance(Feature a, Feature b, double z_a, double z_b, bool same_layout) const {
  const auto i = std::find(features.begin(), features.end(), a), j = std::find(features.begin(), features.end(), b);
  if (i == features.end() || j == features.end()) return 0.0;
  const Eigen::Index r = i - features.begin(), c = j - features.begin();
  return shared(r, c) + z_a * z_b * rigid(r, c) + (same_layout ? layout(r, c) : 0.0);
}

FractureDiscretisation read_fracture_discretisation(const std::filesystem::path& file, tester::Fidelity fidelity) {
  const toml::table document = read_toml_file(file);
  FractureDiscretisation floor;
  const toml::table* table = document[tester::to_string(fidelity)]["curve"].as_table();
  if (table == nullptr) return floor;
  const std::string place = fmt::format("{}: [{}.curve]", file.string(), tester::to_string(fidelity));
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

}  // namespace nacre::diagnosis
