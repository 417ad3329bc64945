#pragma once
// The two sides of an extended model.

#include "material/extensions.hpp"
#include "material/parameters.hpp"
#include "optimize/pareto.hpp"
#include "sysid/prediction.hpp"

namespace nacre::game {

/// The part of the model that simulations know: effects of the testing machine act only where a prediction meets a
/// measurement, and the game must not optimise the machine's faults.
material::ParameterSet material_side(material::ParameterSet parameters);

/// Whether the model holds effects of the testing machine.
bool has_measurement_side(const material::ParameterSet& parameters);

/// What the testing machine makes of a prediction of the material side; without such effects the prediction itself,
/// which then needs no curve.
sysid::Prediction through_machine(const sysid::Prediction& prediction, const material::ParameterSet& model);

/// The same of what a gamut says of a pattern. Measured and gamut fronts meet in what the machine shows.
optimize::Performance through_machine(const optimize::Performance& performance, const material::ParameterSet& model);

/// What the material side must say of a specimen for the machine to show this: the way back, for prints that have not
/// drifted. Measured lines and gamuts meet in what the material does.
optimize::Performance behind_machine(const optimize::Performance& measured, const material::ParameterSet& model);

}  // namespace nacre::game
