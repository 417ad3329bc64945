#pragma once
// The two sides of an extended model.

#include "material/extensions.hpp"
#include "material/parameters.hpp"
#include "optimize/pareto.hpp"
#include "sysid/prediction.hpp"

namespace nacre::game {

/// The material side, the part of the model that simulations know: effects of the testing machine act only where a
/// prediction is compared with a measurement, and the game must not optimise the machine's errors.
material::ParameterSet material_side(material::ParameterSet parameters);

/// Whether the model holds effects of the testing machine.
bool has_measurement_side(const material::ParameterSet& parameters);

/// A prediction of the material side as the testing machine would record it; without such effects the prediction
/// itself, which then needs no curve.
sysid::Prediction through_machine(const sysid::Prediction& prediction, const material::ParameterSet& model);

/// The same for a pattern of a gamut. Measured and gamut fronts are compared as recorded.
optimize::Performance through_machine(const optimize::Performance& performance, const material::ParameterSet& model);

/// The inverse: the properties on the material side that are recorded as `measured`, for prints that have not drifted.
/// Measured lines and gamuts are compared on the material side.
optimize::Performance behind_machine(const optimize::Performance& measured, const material::ParameterSet& model);

}  // namespace nacre::game
