#include "tester/fidelity.hpp"

#include <gtest/gtest.h>

#include "material/parameters.hpp"
#include "pattern/design.hpp"
#include "tester/fracture_test.hpp"
#include "tester/modulus.hpp"
#include "tester/refinement.hpp"

namespace nacre::tester {
namespace {

Simulation simulation_at(Fidelity fidelity) {
  Simulation simulation;
  simulation.design = pattern::design_from_name("4bad85292cfdb9").value();
  simulation.parameters = material::default_parameters();
  simulation.fidelity = fidelity;
  return simulation;
}

TEST(FineFidelity, IsFullOnElementsOfHalfTheSize) {
  Simulation full = simulation_at(Fidelity::full);
  full.parameters = refined(full.parameters, 2);
  const FractureTest fine = fracture_test(simulation_at(Fidelity::fine)),
                     refined = fracture_test(full, {.refinement = 2});
  EXPECT_EQ(fine.grid.columns, 400);
  EXPECT_EQ(fine.grid.rows, 320);
  EXPECT_EQ(fine.grid.element_size_m, refined.grid.element_size_m);
  EXPECT_EQ(fine.grid.threshold_j_per_m3, refined.grid.threshold_j_per_m3) << "the same specimen";
  EXPECT_EQ(fine.settings.gamma_per_s, refined.settings.gamma_per_s);
  EXPECT_EQ(fine.settings.strain_rate_per_s, refined.settings.strain_rate_per_s);
}

TEST(FineFidelity, HasItsModulusFromTheSameElements) {
  EXPECT_EQ(test_modulus(simulation_at(Fidelity::fine)).value().modulus_pa,
            test_modulus(simulation_at(Fidelity::full), {.refinement = 2}).value().modulus_pa);
}

}  // namespace
}  // namespace nacre::tester
