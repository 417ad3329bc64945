#pragma once
// Columns that may be the measurement of a quantity, and which of them comes first.

#include <cstddef>
#include <string>
#include <tuple>

#include "measurement/tester_columns.hpp"

namespace nacre::measurement {

/// What is known of a column before it is chosen.
struct CandidateColumn {
  std::size_t column = 0;
  const ColumnName* name = nullptr;
  int match = 0;               ///< of the name that the sheet gives
  bool has_unit = false;       ///< one that the quantity has
  bool is_dead = false;        ///< its numbers do not move, or it has hardly any
  bool is_cut = false;         ///< it stays at its largest number: a load cell at its limit
  bool goes_back = false;      ///< a clock that does
  bool is_clock_time = false;  ///< hh:mm:ss
};

/// What decides between two columns before their places do: the smaller comes first.
inline auto order_of(const CandidateColumn& each) {
  return std::tuple(each.is_dead, each.name->role, each.is_cut, !each.has_unit, each.name->is_qualified,
                    each.name->rank);
}

/// Why the one that was taken comes before another.
std::string reason_for(const CandidateColumn& taken, const CandidateColumn& other);

}  // namespace nacre::measurement
