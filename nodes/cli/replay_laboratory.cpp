#include "replay_laboratory.hpp"

#include "virtual_lab/virtual_lab_core.hpp"

namespace nacre::cli {

runtime::NodeProgram make_laboratory(const game::Scenario& scenario) {
  return {.core = virtual_lab::make_core(scenario),
          .work = virtual_lab::work_functions(virtual_lab::truth_of(scenario))};
}

}  // namespace nacre::cli
