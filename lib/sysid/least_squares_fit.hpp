#pragma once
// Gauss-Newton steps with Levenberg-Marquardt damping on residuals r = log(simulated / measured), reweighted towards
// the absolute error of (2.8).

#include <memory>

#include "sysid/fit.hpp"

namespace nacre::sysid {

/// Residuals of log E in the six dimensions of theta that act (gamma does not, in the static tester). Jacobian by
/// finite differences: one batch of six evaluations.
std::unique_ptr<ParameterFit> make_modulus_fit(FitData data, const FitSettings& settings);

/// Residuals of log T and log peak stress, slopes by differences that are wide enough to step over the jumps; one batch
/// of seven evaluations each.
std::unique_ptr<ParameterFit> make_gauss_newton_fit(FitData data, const FitSettings& settings);

}  // namespace nacre::sysid
