#include "dashboard/design_view.hpp"

#include "game/standings.hpp"
#include "pattern/constraints.hpp"

namespace nacre::dashboard {

DesignRow design_row(const run::RunRecord& run, const pattern::Design& design) {
  const std::string name = design.name();
  DesignRow row{.design = design, .violation = {}, .proposals = {}, .simulated = {}, .cracks = {}, .specimens = {}};
  if (const auto symmetric = game::eightfold_pattern(design)) row.violation = pattern::violation(*symmetric);
  const wire::SimulatedDesign* by_model = nullptr;
  for (const auto& [number, round] : run.rounds) {
    for (const wire::ProposedDesign& each : round.proposals)
      if (each.design == design) row.proposals.push_back({number, &each});
    if (!round.repeats_model) by_model = nullptr;
    if (const auto found = round.simulated.find(name); found != round.simulated.end()) by_model = &found->second;
    if (by_model != nullptr) row.simulated.push_back({number, by_model});
    if (const auto found = round.cracks.find(name); found != round.cracks.end())
      row.cracks.push_back({number, &found->second});
  }
  for (const run::MeasuredSpecimen& specimen : run.specimens)
    if (specimen.record.design == design) row.specimens.push_back({&specimen});
  return row;
}

}  // namespace nacre::dashboard
