#pragma once
// What simulations and fits begin with: parameters, and the ranges that their failure criterion has.

#include <filesystem>

#include "material/parameters.hpp"
#include "material/ranges.hpp"

namespace nacre::material {

struct StartingModel {
  ParameterSet parameters;
  ParameterRanges ranges;
};

/// The parameters of a file (empty: none) over the built-in ones of its criterion, these brought inside the ranges: of
/// a file (empty: none), where absent those of the criterion. Throws InputError.
StartingModel starting_model(const std::filesystem::path& parameters, const std::filesystem::path& ranges);

}  // namespace nacre::material
