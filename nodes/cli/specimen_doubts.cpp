#include "specimen_doubts.hpp"

#include <algorithm>
#include <iterator>
#include <set>

#include "game/measurement_book.hpp"
#include "game/plausibility.hpp"
#include "game/starting_point.hpp"
#include "measurement/consistency.hpp"

namespace nacre::cli {

using dashboard::SpecimenDoubt;

namespace {

/// Doubts about new specimens that those of the run raise, and not they among themselves.
std::vector<SpecimenDoubt> beside_replicates(std::vector<measurement::SpecimenRecord> known,
                                             std::span<const measurement::SpecimenRecord> specimens) {
  std::set<std::string> asked;
  for (const measurement::SpecimenRecord& specimen : specimens) asked.insert(specimen.specimen);
  for (const auto& doubt : measurement::doubts_of_units({specimens.begin(), specimens.end()}))
    asked.erase(doubt.specimen);
  std::erase_if(known, [&](const auto& each) { return asked.contains(each.specimen); });
  known.insert(known.end(), specimens.begin(), specimens.end());
  std::vector<SpecimenDoubt> doubts;
  for (const auto& doubt : measurement::doubts_of_units(known))
    if (asked.contains(doubt.specimen)) doubts.push_back({doubt.specimen, true, doubt.text});
  return doubts;
}

}  // namespace

std::vector<SpecimenDoubt> doubts_about(const RunAccess& run, const LaboratoryView& view,
                                        std::span<const measurement::SpecimenRecord> specimens) {
  const game::LaboratoryFacts& facts = view.facts;
  game::UnitDoubts units(view.model ? *view.model : game::starting_model(run.scenario).parameters,
                         run.scenario.fidelity);
  std::vector<SpecimenDoubt> doubts;
  for (const measurement::SpecimenRecord& specimen : specimens) {
    if (const auto doubt = game::order_mismatch(specimen, facts.orders))
      doubts.push_back({specimen.specimen, false, *doubt});
    if (const auto doubt = units.about(specimen)) doubts.push_back({specimen.specimen, true, *doubt});
  }
  std::ranges::copy(beside_replicates(facts.book.specimens(), specimens), std::back_inserter(doubts));
  return doubts;
}

}  // namespace nacre::cli
