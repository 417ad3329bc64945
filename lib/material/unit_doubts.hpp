#pragma once
// Whether parameters, or their ranges, may have been given in another unit.

#include <string>
#include <vector>

#include "material/ranges.hpp"

namespace nacre::material {

/// A sentence on each value of the set in `file` that lies a hundred times outside the ranges in which it is fitted.
std::vector<std::string> unit_doubts(const std::string& file, const ParameterSet& set, const ParameterRanges& ranges);

/// The same of ranges, beside those of the thesis.
std::vector<std::string> unit_doubts(const std::string& file, const ParameterRanges& ranges);

}  // namespace nacre::material
