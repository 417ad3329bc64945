#include "dashboard/round_price.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/counted.hpp"
#include "game/budget.hpp"

namespace nacre::dashboard {
namespace {

fabricate::Price price_of(const game::Scenario& scenario, std::vector<fabricate::WantedSpecimens> specimens) {
  if (specimens.empty()) return {};
  return fabricate::price_of(fabricate::plan_job({.name = "priced",
                                                  .wanted = std::move(specimens),
                                                  .printer = printer_of(scenario),
                                                  .rates = rates_of(scenario)}));
}

bool is_rejected(const game::LaboratoryFacts& facts, const pattern::Design& design) {
  return std::ranges::any_of(facts.approvals,
                             [&](const game::StatedApproval& each) { return !each.approved && each.design == design; });
}

/// Designs proposed for the round that are neither ordered nor rejected.
std::vector<pattern::Design> waiting(const game::LaboratoryFacts& facts, int round) {
  std::vector<pattern::Design> designs;
  for (const game::ProposedForRound& each : facts.proposed)
    if (each.round == round - 1 && !game::are_both_ordered(facts.orders, each.design) &&
        !is_rejected(facts, each.design))
      designs.push_back(each.design);
  return designs;
}

}  // namespace

fabricate::WantedSpecimens wanted(const game::Order& order, int replicates) {
  return {.design = order.design,
          .test = order.test,
          .orientation_deg = order.conditions.orientation_deg,
          .thickness_mm = order.conditions.thickness_mm,
          .strain_rate_per_s = order.conditions.strain_rate_per_s,
          .loading = order.loading,
          .replicates = replicates,
          .order_id = order.id,
          .reason = std::string(game::to_string(order.reason))};
}

fabricate::Rates rates_of(const game::Scenario& scenario) {
  return {scenario.laboratory.layers_per_minute, scenario.laboratory.minutes_per_test};
}

fabricate::Printer printer_of(const game::Scenario& scenario) {
  return {.tray_x_mm = scenario.laboratory.tray_x_mm, .tray_y_mm = scenario.laboratory.tray_y_mm};
}

RoundPrice price_of_round(const game::Scenario& scenario, const game::LaboratoryFacts& facts, int round) {
  const auto is_proposed = [&](const game::ProposedForRound& each) { return each.round == round - 1; };
  RoundPrice price{.round = round,
                   .is_expected = std::ranges::none_of(facts.proposed, is_proposed),
                   .all = {},
                   .left = {},
                   .budget = game::budget_in_words(scenario, round)};
  std::vector<game::Order> orders;
  if (price.is_expected) {
    orders = game::expected_orders(scenario, round);
  } else {
    std::ranges::copy_if(facts.orders, std::back_inserter(orders), [&](const game::Order& order) {
      return order.round == round && order.reason != game::OrderReason::family;
    });
    std::ranges::move(game::proposal_orders(game::within_budget(scenario, round), round, waiting(facts, round)),
                      std::back_inserter(orders));
  }
  const auto printed = game::printed_for(orders, facts.printed);
  const auto progress = facts.book.progress(orders, facts.enough_valid);
  std::vector<fabricate::WantedSpecimens> all, left;
  for (std::size_t i = 0; i < orders.size(); ++i) {
    all.push_back(wanted(orders[i], orders[i].replicates));
    const int missing = orders[i].replicates - std::max(printed[i], progress[i].arrived);
    if (!progress[i].complete && !facts.withdrawals.is_withdrawn(orders[i].id) && missing > 0)
      left.push_back(wanted(orders[i], missing));
  }
  price.all = price_of(scenario, std::move(all));
  price.left = price_of(scenario, std::move(left));
  return price;
}

std::string in_words(const RoundPrice& price) {
  std::string words =
      fmt::format("round {}{}: {}", price.round, price.is_expected ? ", as expected" : "", in_words(price.all));
  if (price.left.specimens < price.all.specimens)
    words += price.left.specimens == 0
                 ? "; all are printed"
                 : fmt::format("; {} to be printed yet", counted(price.left.specimens, "specimen"));
  return price.budget.empty() ? words : fmt::format("{}; {}", words, price.budget);
}

}  // namespace nacre::dashboard
