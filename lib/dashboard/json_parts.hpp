#pragma once
// Parts of the page's rows that several views share (docs/FORMATS.md, "Dashboard"). SI units.

#include <array>
#include <optional>
#include <vector>

#include "dashboard/page_fields.hpp"
#include "measurement/conditions.hpp"

namespace nacre::dashboard {

/// A value, or null where there is none.
template <typename Value>
Json json_or_null(const std::optional<Value>& value) {
  return wire::json_of(value);
}

/// Strains and stresses of a curve.
struct CurveRow {
  static constexpr std::string_view kPageName = "Curve";
  std::vector<double> strain, stress_pa;

  static void fields(auto& field, auto& m) {
    field("strain", m.strain);
    field("stress_pa", m.stress_pa);
  }
};

/// At most 400 points of a curve; nothing of an empty one.
std::optional<CurveRow> curve_row(const tester::Curve& curve);

/// E and T as two numbers.
std::vector<std::array<double, 2>> points_of(const std::vector<optimize::Performance>& performances);

/// How a specimen is tested, among the fields of its row; `standard`: at the usual rate and thickness.
void condition_fields(auto& field, const tester::TestConditions& conditions) {
  FieldsOf<tester::TestConditions>::fields(field, conditions);
  field("standard", measurement::is_standard(conditions));
}

}  // namespace nacre::dashboard
