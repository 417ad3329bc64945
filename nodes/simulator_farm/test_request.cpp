#include "simulator_farm/test_request.hpp"

#include <utility>

#include "game/model.hpp"
#include "runtime/journal.hpp"
#include "simulator_farm/farm_core.hpp"

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

Extras wanted_extras(const wire::SimulateRequest& request, tester::TestKind test) {
  if (test != tester::TestKind::toughness) return {};
  return {.curve = request.curve_points > 0, .crack = request.crack, .film = request.film};
}

tester::Simulation simulation_of(const wire::SimulateRequest& request, const pattern::Design& design) {
  return {design, game::material_side(request.parameters), request.conditions, request.fidelity};
}

std::vector<tester::TestKind> tests_of(const wire::SimulateRequest& request) {
  std::vector<tester::TestKind> tests;
  if (request.modulus) tests.push_back(tester::TestKind::modulus);
  if (request.toughness) tests.push_back(tester::TestKind::toughness);
  return tests;
}

wire::SimulateRequest test_request_of(const wire::SimulateRequest& request, const pattern::Design& design,
                                      tester::TestKind test, const Extras& extras) {
  wire::SimulateRequest test_request = request;
  test_request.request_id = kRequestId;
  test_request.modulus = test == tester::TestKind::modulus;
  test_request.toughness = test == tester::TestKind::toughness;
  test_request.curve_points = extras.curve ? kCurvePoints : 0;
  test_request.crack = extras.crack;
  test_request.film = extras.film;
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
