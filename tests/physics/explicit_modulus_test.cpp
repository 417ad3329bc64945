// The explicit modulus tester of the thesis against the static one, which is its limit.

#include <gtest/gtest.h>

#include "fem/static_solver.hpp"
#include "tester/assembly.hpp"
#include "tester/modulus_explicit.hpp"
#include "thesis/constants.hpp"

namespace nacre {
namespace {

double static_modulus(const fem::Grid& grid) {
  return fem::pull(grid, thesis::kModulusStrain).value().top_stress_pa / thesis::kModulusStrain;
}

// At gamma = 1e5 /s and 3e5 /s the specimen is at rest after 10^4 steps (energies decay at least as exp(-gamma t), t =
// 1 ms): 0.1 %.
TEST(ExplicitModulus, ConvergesToTheStaticModulus) {
  for (const char* name : {"577fffe9fffdef", "3ffc9b4ad4d2d9"}) {
    const fem::Grid grid = tester::assemble(pattern::design_from_name(name).value(), material::default_parameters(), {},
                                            tester::AssemblyTarget::modulus, 1, 1);
    const double expected = static_modulus(grid);
    for (const double gamma_per_s : {1e5, 3e5})
      EXPECT_NEAR(tester::explicit_modulus(grid, gamma_per_s).value() / expected, 1.0, 1e-3)
          << name << " " << gamma_per_s;
  }
}

TEST(ExplicitModulus, IsWhatTheTesterGivesWhenAsked) {
  tester::Simulation simulation{.design = pattern::design_from_name("577fffe9fffdef").value(),
                                .parameters = material::default_parameters(),
                                .conditions = {},
                                .fidelity = tester::Fidelity::tiny};
  simulation.parameters.modulus.gamma_per_s = 2e5;
  const double explicit_pa = tester::test_modulus(simulation, {.explicit_modulus = true}).value().modulus_pa;
  const double static_pa = tester::test_modulus(simulation).value().modulus_pa;
  EXPECT_NE(explicit_pa, static_pa);
  EXPECT_NEAR(explicit_pa / static_pa, 1.0, 1e-3);
}

}  // namespace
}  // namespace nacre
