#pragma once
// The two sides of an extended model.

#include "material/extensions.hpp"
#include "material/parameters.hpp"

namespace nacre::game {

/// The part of the model that simulations know: effects of the testing machine act only where a prediction meets a
/// measurement, and the game must not optimise the machine's faults.
material::ParameterSet material_side(material::ParameterSet parameters);

/// Whether the model holds effects of the testing machine.
bool has_measurement_side(const material::ParameterSet& parameters);

}  // namespace nacre::game
