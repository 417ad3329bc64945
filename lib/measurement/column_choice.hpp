#pragma once
// Which columns of an export a specimen's sheet names, where the usual choice is not meant.

#include <string>
#include <string_view>
#include <vector>

#include "measurement/tester_vocabulary.hpp"

namespace nacre::measurement {

/// Headings, or words of them; empty: the usual ones.
struct ColumnChoice {
  std::string extension, force;
  std::string time, strain, stress;
  bool extension_falls = false;  ///< in tension: its column counts downwards
  std::string unit;              ///< units of columns whose headings have none, `mm kN s`
  const std::string& of(Quantity quantity) const {
    switch (quantity) {
      case Quantity::time:
        return time;
      case Quantity::extension:
        return extension;
      case Quantity::force:
        return force;
      case Quantity::strain:
        return strain;
      default:
        return stress;
    }
  }
  bool operator==(const ColumnChoice&) const = default;
};

/// The units that a sheet gives, `mm kN s`, one by one.
std::vector<std::string> units_of_sheet(const ColumnChoice& choice);

/// How well a heading answers to a wanted name: 3 it is the name, 2 it is but for case, accents and the unit, 1 it
/// holds its words, 0 not at all.
int match(std::string_view heading, std::string_view name_without_unit, std::string_view wanted);

}  // namespace nacre::measurement
