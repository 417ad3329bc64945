// The farm with made-up simulations, for soaks of many rounds: cores, messages, journals and files are those of a game.

#include "made_up.hpp"
#include "runtime/node_main.hpp"
#include "simulator_farm/farm_core.hpp"
#include "simulator_farm/test_request.hpp"

namespace nacre {
namespace {

std::string simulate(const std::string& spec) {
  const auto request = wire::read<wire::SimulateRequest>(spec).value();
  const simulator_farm::WantedTest wanted = simulator_farm::tests_of(request).front();
  const soak::MadeUp result = soak::made_up(request.designs.front().name());
  simulator_farm::TestResponse response;
  response.design.design = request.designs.front();
  if (wanted.test == tester::TestKind::modulus) {
    response.design.modulus_pa = result.modulus_pa;
  } else {
    response.design.toughness_pa = tester::area_under(result.curve);
    response.design.specimens = 1;
    response.design.failure_strain = result.curve.strain.back();
    if (wanted.extras.curve) response.design.curve = result.curve;
  }
  return simulator_farm::write_response(response);
}

}  // namespace
}  // namespace nacre

int main(int argc, char** argv) {
  using namespace nacre;
  const auto make = [](const runtime::NodeOptions&, const game::Scenario& scenario) {
    return runtime::NodeProgram{.core = simulator_farm::make_core(scenario), .work = {{"simulate", simulate}}};
  };
  return runtime::node_main(argc, argv, "simulator_farm", make);
}
