#pragma once
// A SIMULATE request taken apart into test requests: one design, one test and one specimen each.

#include <optional>
#include <string>
#include <vector>

#include "wire/convert.hpp"

namespace nacre::simulator_farm {

/// What a response holds in addition to the numbers.
struct Extras {
  bool curve = false;
  bool crack = false;
  bool film = false;
  bool covers(const Extras& other) const {
    return (curve || !other.curve) && (crack || !other.crack) && (film || !other.film);
  }
  bool fracture() const { return crack || film; }
  bool operator==(const Extras&) const = default;
};
Extras operator|(const Extras& a, const Extras& b);

/// "curve+film": for ids.
std::string to_string(const Extras& extras);

/// A test of every design of a request.
struct WantedTest {
  tester::TestKind test = tester::TestKind::modulus;
  int specimen = 0;  ///< of a fracture test
  Extras extras;     ///< of the first specimen alone
};
/// Tests of a request. Where all specimens of a design are alike, one stands for all.
std::vector<WantedTest> tests_of(const wire::SimulateRequest& request);

/// What the request wants beside the numbers of that specimen's test; nothing where it does not want the test.
Extras wanted_extras(const wire::SimulateRequest& request, tester::TestKind test, int specimen);

/// What the testers simulate for a design of the request. Effects of the testing machine are left out: the simulator
/// does not know them.
tester::Simulation simulation_of(const wire::SimulateRequest& request, const pattern::Design& design, int specimen = 0);

/// The test request that is a Compute's spec.
wire::SimulateRequest test_request_of(const wire::SimulateRequest& request, const pattern::Design& design,
                                      const WantedTest& wanted);

/// Result of a Compute: the response to one test request, and how the design broke when that was asked for and the
/// simulation did not fail.
struct TestResponse {
  wire::SimulatedDesign design;
  std::optional<wire::Fracture> fracture;
};
std::string write_response(const TestResponse& response);
Result<TestResponse> read_response(const std::string& bytes);

}  // namespace nacre::simulator_farm
