// The explicit modulus tester of the thesis against the static one, which is its limit.

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "fem/static_solver.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/assembly.hpp"
#include "tester/modulus.hpp"
#include "tester/modulus_explicit.hpp"
#include "thesis/constants.hpp"

namespace nacre {
namespace {

double static_modulus(const fem::Grid& grid) {
  return fem::pull(grid, thesis::kModulusStrain).value().top_stress_pa / thesis::kModulusStrain;
}

// Run until E changes by less than 1e-5 over 1000 steps, at gamma = 1e5 /s and 3e5 /s: 0.1 %. Full specimens, from a
// soft network with rigid islands to a stiff frame.
TEST(ExplicitModulus, AtRestIsTheStaticModulus) {
  std::vector<pattern::Design> designs = {pattern::design_from_name("577fffe9fffdef").value(),
                                          pattern::design_from_name("3ffc9b4ad4d2d9").value()};
  RandomStream random(1, "explicit modulus test");
  for (const int rigid_percent : {50, 65, 80}) designs.emplace_back(pattern::random_pattern(rigid_percent, random));
  for (const pattern::Design& design : designs) {
    const fem::Grid grid =
        tester::assemble(design, material::thesis_parameters(), {}, tester::AssemblyTarget::modulus, 2, 1);
    const double expected = static_modulus(grid);
    for (const double gamma_per_s : {1e5, 3e5})
      EXPECT_NEAR(tester::explicit_modulus_at_rest(grid, gamma_per_s).value() / expected, 1.0, 1e-3)
          << design.name() << " " << gamma_per_s;
  }
}

TEST(ExplicitModulus, IsWhatTheTesterGivesWhenAsked) {
  tester::Simulation simulation{.design = pattern::design_from_name("577fffe9fffdef").value(),
                                .parameters = material::thesis_parameters(),
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
