#pragma once
// Constants of the three materials and of homogeneous mixtures of the two base materials.

#include "material/parameters.hpp"

namespace nacre::material {

/// Elastic constants of Eq. 2.3 and failure threshold of one material.
struct Constants {
  double young_pa = 0.0;
  double poisson = 0.0;
  double threshold_j_per_m3 = 0.0;
};

/// The materials of one tester.
struct Phases {
  Constants soft, interface, rigid;
};

/// From theta: thresholds are infinite, nothing fails.
Phases phases_of(const ModulusParameters& theta);
/// From eta.
Phases phases_of(const ToughnessParameters& eta);

/// Constants of a homogeneous mixture of that rigid fraction, 0 to 1: log10 E, log10 W and nu run piecewise linearly
/// through soft (0), interface (0.5) and rigid (1), and meet these three exactly.
Constants mixture(const Phases& phases, double rigid_fraction);

}  // namespace nacre::material
