#include "golden_nodes.hpp"

#include <memory>

#include "analyser/analyser_core.hpp"
#include "analyser/works.hpp"
#include "proposal_agent/proposal_core.hpp"
#include "proposal_agent/selection_work.hpp"
#include "simulator_farm/farm_core.hpp"
#include "simulator_farm/simulate_work.hpp"
#include "store/simulation_cache.hpp"
#include "validation_agent/family_work.hpp"
#include "validation_agent/validation_core.hpp"
#include "virtual_lab/virtual_lab_core.hpp"

namespace nacre::golden {

namespace fs = std::filesystem;

runtime::NodeProgram make_node(const std::string& node, const game::Scenario& scenario, const fs::path& scratch) {
  fs::create_directories(scratch);
  if (node == "validation_agent")
    return {.core = validation_agent::make_core(scenario), .work = validation_agent::work_functions(scratch)};
  if (node == "proposal_agent")
    return {.core = proposal_agent::make_core(scenario), .work = proposal_agent::work_functions()};
  if (node == "analyser") return {.core = analyser::make_core(scenario), .work = analyser::work_functions(scratch)};
  if (node == "simulator_farm") {
    const auto cache = std::make_shared<store::SimulationCache>(":memory:");
    return {.core = simulator_farm::make_core(scenario),
            .work = simulator_farm::work_functions(cache, scratch / "films")};
  }
  return {.core = virtual_lab::make_core(scenario),
          .work = virtual_lab::work_functions(virtual_lab::truth_of(scenario))};
}

}  // namespace nacre::golden
