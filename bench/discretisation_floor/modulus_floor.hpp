#pragma once
// log E(h/2) - log E(h) over layouts and parameter sets, before and after a refit of the elastic constants.

#include <string>

#include "floor_rows.hpp"

namespace nacre::discretisation_floor {

/// Change of log E when the elements are halved, over all layouts and parameter sets of a plan.
struct ModulusFloor {
  double mean = 0.0;         ///< of log E(h/2) - log E(h)
  double sd_rescaled = 0.0;  ///< after one common factor per parameter set
  double sd = 0.0;           ///< after a refit of the six constants per parameter set
  double at_sd[2] = {};      ///< the same below and from 75 % rigid
  /// log E(0) - log E(h) = amplitude x (log E(h/2) - log E(h)) + remainder, with E(0) extrapolated from h, h/2 and h/4.
  double mesh_amplitude = 0.0;
  double mesh_remainder_sd = 0.0;
  double observed_order = 0.0;                 ///< log2 of the ratio of the two changes, mean
  std::vector<std::vector<double>> residuals;  ///< [set][layout], after the refit
};

/// About (8 x 8 + 1 + 16) x layouts x parameter sets modulus tests of the size at h.
ModulusFloor modulus_floor(const FloorPlan& plan, int threads);

/// Keys of data/discretisation_floor.toml.
std::string to_toml(const ModulusFloor& floor, const FloorPlan& plan);

}  // namespace nacre::discretisation_floor
