#pragma once
// Voxels of scattering strength: the extension `strength_scatter`.

#include <string_view>

#include "fem/grid.hpp"

namespace nacre::tester {

/// Multiplies the thresholds by Weibull factors of mean 1 and that coefficient of variation, one per unrefined element.
/// The uniform numbers behind them depend on `specimen` alone, so that a larger scatter moves the same voxels further
/// and a fit is smooth; another name is another specimen of the same print. No change at 0.
void scatter_strength(fem::Grid& grid, int refinement, double variation, std::string_view specimen);

/// Shape k of the Weibull distribution with that coefficient of variation: v^2 = Gamma(1 + 2/k) / Gamma(1 + 1/k)^2 - 1.
double weibull_shape(double variation);

}  // namespace nacre::tester
