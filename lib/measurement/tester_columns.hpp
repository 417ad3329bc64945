#pragma once
// The meaning of the columns of a testing machine's export: names in several languages, metric and imperial units.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nacre::measurement {

enum class Quantity { time, extension, force };
std::string_view to_string(Quantity quantity);

/// Examples of names and units, for error messages.
std::string_view expected_names(Quantity quantity);
std::string_view expected_units(Quantity quantity);

/// Factor from a unit, as written in a heading, to s, mm or N; nothing when the quantity has no such unit.
std::optional<double> unit_factor(Quantity quantity, std::string_view unit);

/// The length over which a column of extension was recorded, as far as its name tells.
enum class Gauge { unknown, grips, extensometer };

/// A heading taken apart.
struct ColumnName {
  std::string heading;  ///< as in the file
  std::optional<Quantity> quantity;
  int rank = 0;      ///< among columns of one quantity the smallest rank is taken
  std::string unit;  ///< as written with the name; empty when it is not
  Gauge gauge = Gauge::unknown;
};

/// Recognises `Load (N)`, `Standardkraft [N]`, `Kraft in N`, `Force / kN`, `force_n`, `Axial Displacement`.
ColumnName recognise_column(std::string_view heading);

/// The best column of a quantity, or the one that `wanted` names (by its words); `columns.size()` when there is none.
std::size_t best_column(const std::vector<ColumnName>& columns, Quantity quantity, std::string_view wanted = {});

}  // namespace nacre::measurement
