#pragma once
// How strongly each toughening mechanism acts in the designs whose cracks a run has.

#include <string>
#include <vector>

#include "crack/mechanisms.hpp"
#include "dashboard/json_parts.hpp"
#include "run/run_record.hpp"

namespace nacre::dashboard {

struct DesignMechanismsRow {
  static constexpr std::string_view kPageName = "DesignMechanisms";
  std::string design;
  std::string model;  ///< the number of a round or the name of a family
  crack::Mechanisms mechanisms;

  static void fields(auto& field, auto& m) {
    field("design", m.design);
    field("model", m.model);
    const auto names = crack::mechanism_names();
    const auto values = crack::values_of(m.mechanisms);
    for (std::size_t i = 0; i < names.size(); ++i) field(names[i].name, values[i]);
  }
};

/// Proposals by the model of their round, seeds and variants by that of their family.
struct MechanismsRow {
  static constexpr std::string_view kPageName = "Mechanisms";
  std::vector<DesignMechanismsRow> designs;

  static void fields(auto& field, auto& m) { field("designs", m.designs); }
};
/// Cost: milliseconds a design. A crack that does not fit the specimens of `fidelity` is left out.
MechanismsRow mechanisms_row(const run::RunRecord& run, tester::Fidelity fidelity);

}  // namespace nacre::dashboard
