#pragma once
// What an import takes from its files, for a person to look at before it counts.

#include <string>

#include "measurement/import.hpp"

namespace nacre::report {

/// One HTML page, readable offline: per specimen the curve with its toe, straight part, peak and end, E with its
/// standard error, T, rate, and what was taken for what; then what was refused and every warning.
std::string import_preview(const measurement::Import& import, const std::string& sheet);

}  // namespace nacre::report
