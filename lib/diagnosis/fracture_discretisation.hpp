#pragma once
// Discretisation floor of the fracture tester (data/discretisation_floor.toml, table [FIDELITY.curve];
// docs/studies/discretisation-floor.md).

#include <Eigen/Dense>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "diagnosis/features.hpp"
#include "pattern/design.hpp"
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

/// A layout as it breaks on elements of h and of h/2: features of the same specimens.
struct RefinedLayout {
  pattern::Design design;
  std::vector<FeatureValues> coarse, fine;
  /// Mean change of a feature with finer elements; nothing where some specimen does not show it.
  std::optional<double> change(Feature feature) const;
};

/// The discretisation error of layouts at their own constants: of `table` the shared parts, and as much of its
/// covariance between features of one layout as these layouts, whose change with finer elements is known but for the
/// scatter of few specimens, leave open. A feature that one of them lacks keeps the table's. Without a table the
/// layouts' own.
FractureDiscretisation at_own_constants(const FractureDiscretisation& table, const std::vector<RefinedLayout>& layouts,
                                        const EmulatorRules& rules);

/// Where a layout stands between the rigid fractions of the study: z above.
double rigid_position(const pattern::Design& design);

/// Reads [FIDELITY.curve]; a document without that table knows nothing. Throws InputError naming source and key.
FractureDiscretisation fracture_discretisation_from(std::string_view toml, std::string_view source,
                                                    tester::Fidelity fidelity);

/// The same from a file.
FractureDiscretisation read_fracture_discretisation(const std::filesystem::path& file, tester::Fidelity fidelity);

}  // namespace nacre::diagnosis
