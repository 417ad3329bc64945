#include "tester/toughness.hpp"

#include "tester/fracture_test.hpp"
#include "tester/usable.hpp"

namespace nacre::tester {

Result<ToughnessResult> test_toughness(const Simulation& simulation, const Discretisation& discretisation) {
  if (std::string fault = simulation_fault(simulation, TestKind::toughness); !fault.empty())
    return fail("toughness tester: {}", fault);
  return run_fracture_test<float>(fracture_test(simulation, discretisation));
}

}  // namespace nacre::tester
