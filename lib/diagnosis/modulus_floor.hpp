#pragma once

#include <Eigen/Dense>
#include <filesystem>

#include "tester/names.hpp"

namespace nacre::diagnosis {

/// What the elements of the modulus tester leave of an error in log E (data/discretisation_floor.toml,
/// docs/studies/discretisation-floor.md). Not independent between layouts: the truth lies from the tester about where
/// finer elements lie, by a factor that is not known. That direction is computed for the layouts at hand
/// (FeatureModel::mesh_change); the floor gives the size of the factor and what is left beside it.
struct ModulusFloor {
  double log_modulus_sd = 0.0;  ///< per layout after a base refit, taken as independent: for a first fit
  double mesh_amplitude = 0.0;  ///< standard deviation of the factor on log E(h/2) - log E(h); 0: no common direction
  double mesh_remainder_sd = 0.0;  ///< per layout, beside that direction
};

/// Reads [FIDELITY] log_modulus_sd and, when present, mesh_amplitude and mesh_remainder_sd. Throws InputError naming
/// file and key.
ModulusFloor read_modulus_floor(const std::filesystem::path& file, tester::Fidelity fidelity);

}  // namespace nacre::diagnosis
