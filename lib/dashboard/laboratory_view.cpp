#include "dashboard/laboratory_view.hpp"

#include "measurement/conditions.hpp"
#include "measurement/consistency.hpp"

namespace nacre::dashboard {
namespace {

Json specimens_json(const game::MeasurementBook& book) {
  Json specimens = Json::array();
  for (const measurement::SpecimenRecord& r : book.specimens()) {
    const game::Review* review = book.review_of(r.specimen);
    specimens.push_back(
        {{"specimen", r.specimen},
         {"design", r.design.name()},
         {"test", tester::to_string(r.test)},
         {"orientation_deg", r.conditions.orientation_deg},
         {"strain_rate_per_s", r.conditions.strain_rate_per_s},
         {"thickness_mm", r.conditions.thickness_mm},
         {"standard", measurement::is_standard(r.conditions)},
         {"batch", r.batch},
         {"modulus_pa", json_or_null(r.test == tester::TestKind::modulus ? measurement::modulus_of(r) : r.modulus_pa)},
         {"toughness_pa",
          json_or_null(r.test == tester::TestKind::toughness ? measurement::toughness_of(r) : r.toughness_pa)},
         {"points", r.curve.size()},
         {"valid", r.valid},
         {"note", r.note},
         {"by", review == nullptr ? "" : review->by},
         {"why", review == nullptr ? "" : review->why}});
  }
  return specimens;
}

Json or_null(std::optional<double> value) { return value ? Json(*value) : Json(); }

Json group_json(const measurement::ReplicateGroup& group) {
  Json proposed = Json::array();
  for (const auto& outlier : group.proposed) {
    Json reasons = Json::array();
    for (const auto& reason : outlier.reasons) reasons.push_back(reason.text);
    proposed.push_back({{"specimen", outlier.specimen}, {"reasons", reasons}});
  }
  return {{"design", group.design.name()},
          {"test", tester::to_string(group.test)},
          {"orientation_deg", group.conditions.orientation_deg},
          {"strain_rate_per_s", group.conditions.strain_rate_per_s},
          {"thickness_mm", group.conditions.thickness_mm},
          {"standard", measurement::is_standard(group.conditions)},
          {"state", to_string(group.state)},
          {"tested", group.tested},
          {"valid", group.valid},
          {"proposed_outliers", proposed},
          {"wanted", group.wanted},
          {"mean_pa", or_null(group.mean_pa)},
          {"scatter", or_null(group.scatter)},
          {"mean_without_pa", or_null(group.mean_without_pa)},
          {"scatter_without", or_null(group.scatter_without)},
          {"representative", group.representative}};
}

Json orders_json(const game::LaboratoryFacts& facts) {
  const auto progress = facts.book.progress(facts.orders, facts.enough_valid);
  Json orders = Json::array();
  for (std::size_t i = 0; i < facts.orders.size(); ++i) {
    const game::Order& order = facts.orders[i];
    orders.push_back({{"order", order.id},
                      {"round", order.round},
                      {"design", order.design.name()},
                      {"test", tester::to_string(order.test)},
                      {"orientation_deg", order.conditions.orientation_deg},
                      {"strain_rate_per_s", order.conditions.strain_rate_per_s},
                      {"thickness_mm", order.conditions.thickness_mm},
                      {"loading", tester::to_string(order.loading)},
                      {"batch", order.batch},
                      {"replicates", order.replicates},
                      {"arrived", progress[i].arrived},
                      {"valid", progress[i].valid},
                      {"complete", progress[i].complete},
                      {"reason", game::to_string(order.reason)}});
  }
  return orders;
}

Json states_json(const game::LaboratoryFacts& facts) {
  Json states = Json::array();
  for (const game::DesignState& state : game::design_states(facts)) states.push_back(game::to_json(state));
  return states;
}

Json open_proposal_json(const std::optional<wire::Proposal>& proposal) {
  if (!proposal) return nullptr;
  Json designs = Json::array();
  for (const wire::ProposedDesign& each : proposal->designs) {
    designs.push_back({{"design", each.design.name()},
                       {"modulus_pa", each.modulus_pa},
                       {"toughness_pa", each.toughness_pa},
                       {"bin", each.bin},
                       {"reason", each.reason}});
  }
  return {{"round", proposal->round}, {"simulations", proposal->simulations}, {"designs", designs}};
}

}  // namespace

Json laboratory_json(const Laboratory& laboratory) {
  Json groups = Json::array();
  for (const auto& group :
       measurement::review_replicates(laboratory.facts.book.specimens(), game::consistency_settings(laboratory.facts)))
    groups.push_back(group_json(group));
  return {{"proposal", open_proposal_json(laboratory.open_proposal)},
          {"designs", states_json(laboratory.facts)},
          {"orders", orders_json(laboratory.facts)},
          {"specimens", specimens_json(laboratory.facts.book)},
          {"groups", groups}};
}

}  // namespace nacre::dashboard
