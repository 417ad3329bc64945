#pragma once
// The parameter file (TOML): tables [modulus], [toughness] and [extension.NAME] (docs/FORMATS.md).

#include <filesystem>
#include <string>
#include <string_view>

#include "material/parameters.hpp"

namespace nacre::material {

/// Reads a parameter file; keys that are absent keep the value of `start`, W that of the same fracture energy where the
/// file names another criterion. Unknown tables, keys, extension names and values that are not positive finite numbers
/// (nu: 0 to 0.5) throw InputError naming file, line, key and what was expected.
ParameterSet read_parameters(const std::filesystem::path& path, const ParameterSet& start);
/// The same from text; `source` names the place in errors.
ParameterSet parameters_from_toml(std::string_view text, std::string_view source, const ParameterSet& start);
std::string to_toml(const ParameterSet& parameters);
/// The keys of [toughness] that are none of eta: strength_cv, criterion, and the number that the criterion uses.
std::string failure_toml(const FailureCriterion& criterion, double strength_cv);

}  // namespace nacre::material
