#include "simulator_farm/test_request.hpp"

#include <utility>

#include "game/model.hpp"
#include "runtime/journal.hpp"
#include "simulator_farm/farm_core.hpp"
#include "tester/strength_field.hpp"

namespace nacre::simulator_farm {
namespace {

/// Not part of what is requested: equal test requests are equal specs.
constexpr const char* kRequestId = "simulator_farm/question";

}  // namespace

Extras operator|(const Extras& a, const Extras& b) {
  return {.curve = a.curve || b.curve, .crack = a.crack || b.crack, .film = a.film || b.film};
}

std::string to_string(const Extras& extras) {
  std::string text;
  for (const auto& [wanted, name] : {std::pair{extras.curve, "curve"}, {extras.crack, "crack"}, {extras.film, "film"}})
    if (wanted) text += (text.empty() ? "" : "+") + std::string(name);
  return text;
}

std::vector<WantedTest> tests_of(const wire::SimulateRequest& request) {
  std::vector<WantedTest> tests;
  if (request.modulus) tests.push_back({tester::TestKind::modulus, 0, {}});
  if (!request.toughness) return tests;
  const bool differ = tester::specimens_differ(request.parameters);
  const int first = differ ? request.first_specimen : 0, count = differ ? request.specimens : 1;
  for (int specimen = first; specimen < first + count; ++specimen)
    tests.push_back({tester::TestKind::toughness, specimen, {}});
  tests[request.modulus ? 1 : 0].extras = {
      .curve = request.curve_points > 0, .crack = request.crack, .film = request.film};
  return tests;
}

Extras wanted_extras(const wire::SimulateRequest& request, tester::TestKind test, int specimen) {
  for (const WantedTest& each : tests_of(request))
    if (each.test == test && each.specimen == specimen) return each.extras;
  return {};
}

tester::Simulation simulation_of(const wire::SimulateRequest& request, const pattern::Design& design, int specimen) {
  return {design, game::material_side(request.parameters), request.conditions, request.fidelity, specimen};
}

wire::SimulateRequest test_request_of(const wire::SimulateRequest& request, const pattern::Design& design,
                                      const WantedTest& wanted) {
  wire::SimulateRequest test_request = request;
  test_request.request_id = kRequestId;
  test_request.modulus = wanted.test == tester::TestKind::modulus;
  test_request.toughness = wanted.test == tester::TestKind::toughness;
  test_request.first_specimen = wanted.specimen;
  test_request.specimens = 1;
  test_request.curve_points = wanted.extras.curve ? kCurvePoints : 0;
  test_request.crack = wanted.extras.crack;
  test_request.film = wanted.extras.film;
  test_request.parameters = simulation_of(request, design).parameters;
  test_request.designs = {design};
  return test_request;
}

std::string write_response(const TestResponse& response) {
  const std::string numbers = wire::write(wire::SimulateResult{
      .request_id = kRequestId, .chunk = 0, .chunks = 1, .first = 0, .results = {response.design}});
  if (!response.fracture) return numbers;
  wire::Fracture fracture = *response.fracture;
  fracture.request_id = kRequestId;
  return runtime::pack({numbers, wire::write(fracture)});
}

Result<TestResponse> read_response(const std::string& bytes) {
  std::string numbers = bytes;
  TestResponse response;
  if (const auto fields = runtime::unpack(bytes); fields && fields->size() == 2) {
    auto fracture = wire::read<wire::Fracture>((*fields)[1]);
    if (!fracture) return tl::unexpected(fracture.error());
    response.fracture = *std::move(fracture);
    numbers = (*fields)[0];
  }
  auto result = wire::read<wire::SimulateResult>(numbers);
  if (!result) return tl::unexpected(result.error());
  if (result->results.size() != 1) return fail("{} results of one test request", result->results.size());
  response.design = std::move(result->results.front());
  return response;
}

}  // namespace nacre::simulator_farm
