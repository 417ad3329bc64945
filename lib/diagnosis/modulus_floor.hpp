#pragma once
// Discretisation floor of the modulus tester (data/discretisation_floor.toml, docs/studies/discretisation-floor.md).

#include <filesystem>
#include <string_view>

#include "tester/names.hpp"

namespace nacre::diagnosis {

/// Discretisation error of log E. It is not independent between layouts: true minus simulated value is an unknown
/// factor times the change on a refined mesh, log E(h/2) - log E(h), plus a remainder. That direction is computed for
/// the layouts at hand (FeatureModel::mesh_change); the floor gives the size of factor and remainder.
struct ModulusFloor {
  double log_modulus_sd = 0.0;  ///< per layout after a base refit, taken as independent: for a first fit
  double mesh_amplitude = 0.0;  ///< standard deviation of the factor on log E(h/2) - log E(h); 0: no common direction
  double mesh_remainder_sd = 0.0;  ///< per layout, besides that direction
};

/// Reads [FIDELITY] log_modulus_sd and, when present, mesh_amplitude and mesh_remainder_sd. Throws InputError naming
/// source and key.
ModulusFloor modulus_floor_from(std::string_view toml, std::string_view source, tester::Fidelity fidelity);

/// The same from a file.
ModulusFloor read_modulus_floor(const std::filesystem::path& file, tester::Fidelity fidelity);

}  // namespace nacre::diagnosis
