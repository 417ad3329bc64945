// Breaks a specimen and prints how stiff and how tough it is: a program of one's own that links to nacre::tester.
// Usage: simulate [DESIGN]; a pattern's 14 hex digits, `rigid`, `mix:0.65`, or a file of 20 lines of 0 and 1.

#include <iostream>

#include "tester/modulus.hpp"
#include "tester/toughness.hpp"

int main(int argc, char** argv) try {
  using namespace nacre;
  tester::Simulation simulation;
  simulation.design = pattern::design_from_argument(argc > 1 ? argv[1] : "577fffe9fffdef");
  simulation.parameters = material::default_parameters();
  const auto modulus = tester::test_modulus(simulation);
  const auto fracture = tester::test_toughness(simulation);
  if (!modulus || !fracture) throw InputError((modulus ? fracture.error() : modulus.error()).message);
  std::cout << "E " << 1e-9 * modulus->modulus_pa << " GPa, T " << 1e-6 * fracture->toughness_pa << " MPa\n";
} catch (const nacre::InputError& problem) {
  std::cerr << problem.what() << '\n';
  return 2;
}
