#pragma once
// The model of a round as its record has it.

#include <map>
#include <string>
#include <vector>

#include "material/parameters.hpp"
#include "optimize/pareto.hpp"
#include "run/run_record.hpp"

namespace nacre::run {

/// Extensions of the model of a round; none where its model is not known.
material::Extensions extensions_of(const RoundRecord& round);

/// The homogeneous line of a round as recorded by the testing machine, like everything measured (the model holds what
/// simulations are compared with: the line without the machine effects of the model).
std::vector<optimize::Performance> line_as_measured(const RoundRecord& round);

/// `modulus.NAME`, `toughness.NAME`, `extension.NAME` (`extension.NAME.INDEX` of several values) -> value.
std::map<std::string, double> named_parameters(const material::ParameterSet& parameters);

}  // namespace nacre::run
