#pragma once

#include <string>
#include <string_view>

namespace nacre::material {

/// An effect, or several in one text, as a sentence names it: "droplet mixing" for `droplet_mixing`.
std::string effect_in_words(std::string_view name);

/// The unit of a parameter after a number, with a blank before it; empty where the parameter is a pure number ("1").
std::string unit_behind_number(std::string_view unit);

}  // namespace nacre::material
