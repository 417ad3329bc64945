#include "dashboard/design_check.hpp"

#include "game/standings.hpp"
#include "pattern/constraints.hpp"
#include "tester/modulus.hpp"

namespace nacre::dashboard {

DesignCheckRow checked(const pattern::Design& design, const material::ParameterSet& parameters,
                       tester::Fidelity fidelity) {
  DesignCheckRow row{.design = design, .violations = {}, .soft_corner = {}, .modulus_pa = {}, .problem = {}};
  if (const auto symmetric = game::eightfold_pattern(design)) {
    row.violations = pattern::violations(*symmetric);
    row.soft_corner = pattern::Pattern(pattern::soft_corner_bits(*symmetric)).key();
  } else if (design.layout() != nullptr) {
    row.violations = {"the layout lacks the eightfold symmetry"};
  }
  const auto modulus = tester::test_modulus({design, parameters, {}, fidelity});
  if (modulus) row.modulus_pa = modulus->modulus_pa;
  if (!modulus) row.problem = modulus.error().message;
  return row;
}

}  // namespace nacre::dashboard
