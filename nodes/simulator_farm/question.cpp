#include "simulator_farm/question.hpp"

#include "game/model.hpp"
#include "simulator_farm/farm_core.hpp"

namespace nacre::simulator_farm {

tester::Simulation simulation_of(const wire::SimulateRequest& request, const pattern::Design& design) {
  return {design, game::material_side(request.parameters), request.conditions, request.fidelity};
}

std::vector<tester::TestKind> tests_of(const wire::SimulateRequest& request) {
  std::vector<tester::TestKind> tests;
  if (request.modulus) tests.push_back(tester::TestKind::modulus);
  if (request.toughness) tests.push_back(tester::TestKind::toughness);
  return tests;
}

wire::SimulateRequest question_of(const wire::SimulateRequest& request, const pattern::Design& design,
                                  tester::TestKind test, bool with_curve) {
  wire::SimulateRequest question = request;
  question.request_id = "simulator_farm/question";  // not part of the question: equal questions are equal specs
  question.modulus = test == tester::TestKind::modulus;
  question.toughness = test == tester::TestKind::toughness;
  question.curve_points = with_curve ? kCurvePoints : 0;
  question.parameters = simulation_of(request, design).parameters;
  question.designs = {design};
  return question;
}

}  // namespace nacre::simulator_farm
