#include "dashboard/laboratory_view.hpp"

#include <utility>

namespace nacre::dashboard {

LaboratoryRow laboratory_row(const Laboratory& laboratory) {
  const game::LaboratoryFacts& facts = laboratory.facts;
  LaboratoryRow row;
  if (laboratory.open_proposal) row.proposal = OpenProposalRow{*laboratory.open_proposal};
  row.price = laboratory.price;
  row.designs = game::design_states(facts);
  const auto progress = facts.book.progress(facts.orders, facts.enough_valid);
  for (std::size_t i = 0; i < facts.orders.size(); ++i) {
    const game::Withdrawal* withdrawal = facts.withdrawals.of(facts.orders[i].id);
    row.orders.push_back({facts.orders[i], progress[i], withdrawal == nullptr ? game::Withdrawal{} : *withdrawal});
  }
  for (const game::PrintedSpecimen& printed : facts.printed) row.printed.push_back({printed});
  const std::vector<measurement::SpecimenRecord> specimens = facts.book.specimens();
  for (auto& group : measurement::review_replicates(specimens, game::consistency_settings(facts)))
    row.groups.push_back({std::move(group)});
  for (const measurement::SpecimenRecord& record : specimens) {
    const game::Review* review = facts.book.review_of(record.specimen);
    std::vector<game::Report> reports = facts.book.reports_of(record.specimen);
    LaboratorySpecimenRow specimen{.record = record,
                                   .review = review == nullptr ? game::Review{} : *review,
                                   .amendment = reports.back().amendment};
    reports.pop_back();
    for (game::Report& report : reports) specimen.earlier.push_back({std::move(report)});
    row.specimens.push_back(std::move(specimen));
  }
  return row;
}

}  // namespace nacre::dashboard
