#pragma once
// What simulations and fits begin with: parameters, and the ranges that their failure criterion has.

#include <filesystem>
#include <functional>

#include "material/parameters.hpp"
#include "material/ranges.hpp"

namespace nacre::material {

struct StartingModel {
  ParameterSet parameters;
  ParameterRanges ranges;
};

/// Reads parameters; what they leave out keeps the value of `start`.
using ParameterReader = std::function<ParameterSet(const ParameterSet& start)>;

/// The parameters that are read over the built-in ones of their criterion, these brought inside the ranges: of a file
/// (empty: none), where absent those of the criterion. Throws InputError.
StartingModel starting_model(const ParameterReader& read, const std::filesystem::path& ranges);
/// The parameters of a file; empty: none.
StartingModel starting_model(const std::filesystem::path& parameters, const std::filesystem::path& ranges);

}  // namespace nacre::material
