// The virtual laboratory with made-up tests, for soaks of many rounds.

#include "made_up.hpp"
#include "runtime/node_main.hpp"
#include "virtual_lab/experiment_text.hpp"
#include "virtual_lab/virtual_lab_core.hpp"

namespace nacre {
namespace {

std::string measure(const std::string& spec) {
  const auto experiment = virtual_lab::experiment_from_spec(spec).value();
  const soak::MadeUp result = soak::made_up(experiment.design.name());
  return virtual_lab::to_text(virtual_lab::TrueResponse{.modulus_pa = result.modulus_pa, .curve = result.curve});
}

}  // namespace
}  // namespace nacre

int main(int argc, char** argv) {
  using namespace nacre;
  const auto make = [](const runtime::NodeOptions&, const game::Scenario& scenario) {
    return runtime::NodeProgram{.core = virtual_lab::make_core(scenario), .work = {{"measure", measure}}};
  };
  return runtime::node_main(argc, argv, "virtual_lab", make);
}
