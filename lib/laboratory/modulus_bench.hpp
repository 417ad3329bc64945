#pragma once

#include "base/result.hpp"
#include "laboratory/specimen_raster.hpp"

namespace nacre::laboratory {

/// Young's modulus (Pa) of a rastered specimen between grips that leave its width free: linear elasticity, bilinear
/// elements, sparse Cholesky in double precision. Error: a specimen that hangs together nowhere, or a factorisation
/// that fails.
Result<double> pull_elastically(const Raster& raster);

}  // namespace nacre::laboratory
