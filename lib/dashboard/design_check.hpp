#pragma once
// What is known of a design at once, without a fracture: constraints and modulus.

#include <optional>
#include <string>
#include <vector>

#include "dashboard/json_parts.hpp"
#include "pattern/design.hpp"

namespace nacre::dashboard {

struct DesignCheckRow {
  static constexpr std::string_view kPageName = "DesignCheck";
  pattern::Design design;
  std::vector<std::string> violations;  ///< of the design space
  std::string soft_corner;  ///< key of the pixels that the corner rule requires to be rigid and that are soft
  std::optional<double> modulus_pa;
  std::string problem;  ///< why there is no modulus

  static void fields(auto& field, auto& m) {
    field("design", m.design);
    field("rigid_fraction", m.design.rigid_fraction());
    field("violations", m.violations);
    field("soft_corner", m.soft_corner);
    field("modulus_pa", m.modulus_pa);
    field("problem", m.problem);
  }
};

/// Constraints, and the modulus by the modulus tester. Cost: milliseconds.
DesignCheckRow checked(const pattern::Design& design, const material::ParameterSet& parameters,
                       tester::Fidelity fidelity);

}  // namespace nacre::dashboard
