#pragma once
// The meaning of the columns of a testing machine's export: headings -> quantity, unit and role.

#include <optional>
#include <string>
#include <string_view>

#include "measurement/tester_vocabulary.hpp"

namespace nacre::measurement {

/// Examples of names and units, for error messages.
std::string_view expected_names(Quantity quantity);
std::string_view expected_units(Quantity quantity);
/// s, mm, N, 1, Pa.
std::string_view base_unit(Quantity quantity);

/// Factor from a unit, as written in a heading, to the base unit; nothing when the quantity has no such unit.
std::optional<double> unit_factor(Quantity quantity, std::string_view unit);
/// A unit, as written in a heading, in plain words and without brackets.
std::string bare_unit(std::string_view unit);
/// The same as the file writes it, for people: `N`, not `n`.
std::string unit_as_written(std::string_view unit);

/// The length over which a column of extension was recorded, as far as its name tells.
enum class Gauge { unknown, grips, extensometer };

/// A heading taken apart.
struct ColumnName {
  std::string heading = {};  ///< as in the file
  std::optional<Quantity> quantity = {};
  int rank = 0;           ///< among columns of one quantity the smallest is preferred
  std::string unit = {};  ///< as written with the name; empty when it is not
  Gauge gauge = Gauge::unknown;
  ColumnRole role = ColumnRole::measured;
  std::string other_unit = {};  ///< of the row of units, where it contradicts that of the heading
  bool is_qualified = false;    ///< a word that is not known says more of it (`Grip Force`)
  bool is_other = false;        ///< a word gives the name another meaning (`maximum`, `rate`)
  bool is_specimen = false;     ///< tells which specimen a row belongs to
  bool unit_of_cells = false;   ///< the unit stands behind each number
  std::string name = {};        ///< in plain words, without the unit
};

/// Recognises `Load (N)`, `Standardkraft [N]`, `Kraft in N`, `Force / kN`, `force_n`, `Position (m) Run #1`,
/// `荷重（N）`. A unit corrects a name: an elongation in per cent is a strain.
ColumnName recognise_column(std::string_view heading);
/// The same with the unit of a row of its own, which a unit in the heading outdoes.
ColumnName recognise_column(std::string_view heading, std::string_view unit);

}  // namespace nacre::measurement
