#pragma once
// Headings that stand over two lines, `Axial` above `Displacement`, and rows of units.

#include <string>
#include <string_view>
#include <vector>

#include "measurement/tester_vocabulary.hpp"

namespace nacre::measurement {

/// The cells of two lines of words, joined by column, without the hyphen of a divided word. A cell above several
/// columns (`Load` above `Command`, `Actual`) goes on to the right until the next. Empty where the lines differ in
/// length.
std::vector<std::string> joined_headings(const std::vector<std::string_view>& upper,
                                         const std::vector<std::string_view>& lower);

/// Whether most filled cells of a line say which of several columns is meant: `Command`, `Axial`, `Ist`.
bool tells_roles(const std::vector<std::string_view>& cells);

/// Whether a line is a row of units: most of its filled cells are one, or stand in brackets. `is_known` tells units in
/// plain words.
bool is_unit_row(const std::vector<std::string_view>& cells, bool (*is_known)(std::string_view) = is_unit);

}  // namespace nacre::measurement
