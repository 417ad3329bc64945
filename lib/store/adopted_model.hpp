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

/// The homogeneous line of a round as recorded by the testing machine, like everything measured (the record holds what
/// simulations are compared with: the line without the machine effects of the model).
std::vector<optimize::Performance> line_as_measured(const RoundRecord& round);

}  // namespace nacre::store
