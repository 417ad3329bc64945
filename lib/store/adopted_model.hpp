#pragma once
// The model of a round as its record has it.

#include <vector>

#include "material/extensions.hpp"
#include "optimize/pareto.hpp"
#include "store/run_record.hpp"

namespace nacre::store {

/// Extensions of the model of a round, from its parameters `extension.NAME` and `extension.NAME.INDEX`. Names outside
/// the effect library are left out.
material::Extensions extensions_of(const RoundRecord& round);

/// The homogeneous line of a round as the testing machine shows it, like everything measured (the record holds what
/// simulations are compared with: the line behind the machine that the model knows).
std::vector<optimize::Performance> line_as_measured(const RoundRecord& round);

}  // namespace nacre::store
