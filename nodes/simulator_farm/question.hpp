#pragma once
// A simulate request taken apart into questions, each a request for one design and one test.

#include <string>
#include <vector>

#include "tester/tester.hpp"
#include "wire/convert.hpp"

namespace nacre::simulator_farm {

/// The question as the testers understand it. Effects of the testing machine are left out: the simulator does not know
/// them.
tester::Simulation simulation_of(const wire::SimulateRequest& request, const pattern::Design& design);

/// Tests that a request asks for.
std::vector<tester::TestKind> tests_of(const wire::SimulateRequest& request);

/// The request for one design and test that is a Compute's spec, with a curve or without.
wire::SimulateRequest question_of(const wire::SimulateRequest& request, const pattern::Design& design,
                                  tester::TestKind test, bool with_curve);

}  // namespace nacre::simulator_farm
