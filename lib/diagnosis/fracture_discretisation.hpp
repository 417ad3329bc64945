#pragma once
// Discretisation floor of the fracture tester (data/discretisation_floor.toml, table [FIDELITY.curve];
// docs/studies/discretisation-floor.md).

#include <Eigen/Dense>
#include <filesystem>
#include <vector>

#include "diagnosis/features.hpp"
#include "tester/names.hpp"

namespace nacre::diagnosis {

/// Covariance of the discretisation error in the features of a curve. Between layouts i and j, with
/// z = (rigid fraction - 0.675) / 0.1: covariance = shared + z_i z_j rigid + (i = j) layout.
struct FractureDiscretisation {
  std::vector<Feature> features;          ///< empty: nothing known
  Eigen::MatrixXd shared, rigid, layout;  ///< features x features
  /// Covariance between feature a of one layout and feature b of another (or the same), 0 when one of them is not in
  /// the list.
  double covariance(Feature a, Feature b, double z_a, double z_b, bool same_layout) const;
};

/// Reads [FIDELITY.curve]; a file without that table knows nothing. Throws InputError naming file and key.
FractureDiscretisation read_fracture_discretisation(const std::filesystem::path& file, tester::Fidelity fidelity);

}  // namespace nacre::diagnosis
