#include "replay_laboratory.hpp"

#include "virtual_lab/virtual_lab_core.hpp"

namespace nacre::cli {

runtime::NodeProgram make_laboratory(const game::Scenario& scenario) {
  return {.core = virtual_laboratory::make_core(scenario),
          .work = virtual_laboratory::work_functions(virtual_laboratory::truth_of(scenario))};
}

}  // namespace nacre::cli
