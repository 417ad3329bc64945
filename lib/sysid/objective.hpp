#pragma once
// Pieces of objective (2.8) that the fits share.

#include "measurement/observe.hpp"
#include "measurement/reduction.hpp"
#include "sysid/calibration.hpp"

namespace nacre::sysid {

using measurement::forward_part;

/// A prediction as the testing machine would show it: measurement-side extensions applied to modulus, curve and
/// toughness.
Prediction observed(const Prediction& prediction, const material::Extensions& extensions,
                    const measurement::PrintContext& context = {});
/// The same for a measured design, whose prints may have drifted.
Prediction observed(const Prediction& prediction, const material::Extensions& extensions,
                    const measurement::Replicates& measured);

/// |simulated - measured| / measured; 1 where the simulation gave nothing.
double relative_error(const std::optional<double>& simulated, double measured);

/// Toughness and curve term of one design in (2.8), lambda~ = 1. A failed simulation counts as a curve that is zero.
/// The curve term is left out where no curve was measured, or none was recorded of a simulation that succeeded.
double toughness_misfit(const measurement::Replicates& measured, const Prediction& prediction);

}  // namespace nacre::sysid
