#pragma once
// The part of the discretisation floor that designs have in common: parameters absorb such an error where they can, so
// that residuals do not show it and no number of designs averages it away.

#include <Eigen/Dense>
#include <vector>

#include "measurement/summary.hpp"
#include "sysid/discretisation_floor.hpp"

namespace nacre::sysid {

/// Shift of log E per design, one column: the larger the lower the rigid fraction, where thin soft joints carry the
/// load.
Eigen::MatrixXd shared_modulus_errors(const std::vector<measurement::Replicates>& measured,
                                      const DiscretisationFloor& floor);

/// Shifts of log T (rows 0..N-1) and log peak stress (N..2N-1), of normal size 1 each: one of all designs, in which
/// both features go together as failure energies do (T with W, stress with its root), and one of either that grows
/// along the rigid fraction.
Eigen::MatrixXd shared_fracture_errors(const std::vector<measurement::Replicates>& measured,
                                       const DiscretisationFloor& floor);

}  // namespace nacre::sysid
