#include "dashboard/laboratory_view.hpp"

namespace nacre::dashboard {

LaboratoryRow laboratory_row(const Laboratory& laboratory) {
  const game::LaboratoryFacts& facts = laboratory.facts;
  LaboratoryRow row;
  if (laboratory.open_proposal) row.proposal = OpenProposalRow{*laboratory.open_proposal};
  row.price = laboratory.price;
  row.designs = game::design_states(facts);
  const auto progress = facts.book.progress(facts.orders, facts.enough_valid);
  for (std::size_t i = 0; i < facts.orders.size(); ++i) row.orders.push_back({facts.orders[i], progress[i]});
  const std::vector<measurement::SpecimenRecord> specimens = facts.book.specimens();
  for (auto& group : measurement::review_replicates(specimens, game::consistency_settings(facts)))
    row.groups.push_back({std::move(group)});
  for (const measurement::SpecimenRecord& record : specimens) {
    const game::Review* review = facts.book.review_of(record.specimen);
    row.specimens.push_back({record, review == nullptr ? game::Review{} : *review});
  }
  return row;
}

}  // namespace nacre::dashboard
