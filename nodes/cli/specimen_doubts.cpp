#include "specimen_doubts.hpp"

#include "game/measurement_book.hpp"
#include "game/plausibility.hpp"
#include "game/starting_point.hpp"
#include "laboratory_view.hpp"

namespace nacre::cli {

std::vector<std::string> doubts_about(const RunAccess& run, std::span<const measurement::SpecimenRecord> specimens) {
  const std::vector<game::Order> orders = view_laboratory(run).facts.orders;
  const auto adopted = adopted_parameters(run);
  const material::ParameterSet model = adopted ? *adopted : game::starting_model(run.scenario);
  std::vector<std::string> doubts;
  for (const measurement::SpecimenRecord& specimen : specimens) {
    for (const auto& doubt :
         {game::beside_orders(specimen, orders), game::doubt_of_unit(specimen, model, run.scenario.fidelity)})
      if (doubt) doubts.push_back(*doubt);
  }
  return doubts;
}

}  // namespace nacre::cli
