#include "specimen_doubts.hpp"

#include <set>

#include "game/measurement_book.hpp"
#include "game/plausibility.hpp"
#include "game/starting_point.hpp"
#include "measurement/consistency.hpp"

namespace nacre::cli {
namespace {

/// Doubts about new specimens that those of the run raise, and not they among themselves.
std::vector<std::string> beside_replicates(std::vector<measurement::SpecimenRecord> known,
                                           std::span<const measurement::SpecimenRecord> specimens) {
  std::set<std::string> asked;
  for (const measurement::SpecimenRecord& specimen : specimens) asked.insert(specimen.specimen);
  for (const auto& doubt : measurement::doubts_of_units({specimens.begin(), specimens.end()}))
    asked.erase(doubt.specimen);
  std::erase_if(known, [&](const auto& each) { return asked.contains(each.specimen); });
  known.insert(known.end(), specimens.begin(), specimens.end());
  std::vector<std::string> doubts;
  for (const auto& doubt : measurement::doubts_of_units(known))
    if (asked.contains(doubt.specimen)) doubts.push_back(doubt.text);
  return doubts;
}

}  // namespace

std::vector<std::string> doubts_about(const RunAccess& run, const LaboratoryView& view,
                                      std::span<const measurement::SpecimenRecord> specimens) {
  const game::LaboratoryFacts& facts = view.facts;
  game::UnitDoubts units(view.model ? *view.model : game::starting_model(run.scenario).parameters,
                         run.scenario.fidelity);
  std::vector<std::string> doubts;
  for (const measurement::SpecimenRecord& specimen : specimens) {
    for (const auto& doubt : {game::order_mismatch(specimen, facts.orders), units.about(specimen)})
      if (doubt) doubts.push_back(*doubt);
  }
  for (const std::string& doubt : beside_replicates(facts.book.specimens(), specimens)) doubts.push_back(doubt);
  return doubts;
}

}  // namespace nacre::cli
