#pragma once
// Objective (2.8): weighted mean of |simulated - measured| / measured for E, and for T with a curve term (lambda~ = 1):
// the area between simulated and measured curve over the measured toughness.

#include <optional>
#include <vector>

#include "material/parameters.hpp"
#include "measurement/observe.hpp"
#include "measurement/reduction.hpp"
#include "measurement/summary.hpp"
#include "sysid/prediction.hpp"

namespace nacre::sysid {

using measurement::forward_part;

/// Modulus part of objective (2.8), divided by the sum of weights: 0.1 means 10 % weighted mean error.
double modulus_objective(const std::vector<measurement::Replicates>& measured, const std::vector<double>& weights,
                         const std::vector<Prediction>& predictions);
/// Toughness part of (2.8) with lambda~ = 1, divided by the sum of weights; the curve term only where a curve was
/// measured.
double toughness_objective(const std::vector<measurement::Replicates>& measured, const std::vector<double>& weights,
                           const std::vector<Prediction>& predictions);

/// A prediction as the testing machine would record it: measurement-side extensions applied to modulus, curve and
/// toughness.
Prediction observed(const Prediction& prediction, const material::Extensions& extensions,
                    const measurement::PrintContext& context = {});
/// The same for a measured design, whose prints may have drifted.
Prediction observed(const Prediction& prediction, const material::Extensions& extensions,
                    const measurement::Replicates& measured);

/// |simulated - measured| / measured; 1 where the simulation failed.
double relative_error(const std::optional<double>& simulated, double measured);

/// Toughness and curve term of one design in (2.8), lambda~ = 1. A failed simulation counts as a curve that is zero.
/// The curve term is left out where no curve was measured, or none was recorded of a simulation that succeeded.
double toughness_misfit(const measurement::Replicates& measured, const Prediction& prediction);

}  // namespace nacre::sysid
