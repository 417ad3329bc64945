#pragma once
// One tested specimen, physical or from the virtual laboratory.

#include <map>
#include <optional>
#include <string>

#include "pattern/design.hpp"
#include "tester/curve.hpp"
#include "tester/simulation.hpp"

namespace nacre::measurement {

/// A row of measurements.csv or a MEASUREMENT message.
struct SpecimenRecord {
  std::string specimen;  ///< unique name
  pattern::Design design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::TestConditions conditions;
  std::string batch;
  int print_order = 0;  ///< 0 when unknown
  std::optional<double> modulus_pa;
  std::optional<double> toughness_pa;  ///< a given value wins over the area under the curve
  tester::Curve curve;                 ///< empty when none was recorded
  bool valid = true;
  std::string note;
  /// Columns of the file that nacre does not know, by name, empty cells left out; written back as they were.
  std::map<std::string, std::string> other_columns;
  bool operator==(const SpecimenRecord&) const = default;
};

/// A row that could not be used.
struct RejectedRow {
  int line = 0;
  std::string column;  ///< empty when it is the row as a whole
  std::string reason;  ///< a sentence with what was expected
};

}  // namespace nacre::measurement
