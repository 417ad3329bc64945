#include "game/design_states.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
namespace nacre::game {
namespace {

bool could_answer(const PrintedSpecimen& specimen, const Order& order) {
  return specimen.design == order.design && specimen.test == order.test &&
         std::abs(specimen.orientation_deg - order.conditions.orientation_deg) < 0.5;
}

bool is_proposed(const LaboratoryFacts& facts, const StatedApproval& approval) {
  return std::ranges::any_of(facts.proposed, [&](const ProposedForRound& each) {
    return each.round == approval.proposal_round && each.design == approval.design;
  });
}

/// Proposed, neither approved nor rejected nor ordered, whatever was printed or measured of it already.
bool waits_for_approval(const LaboratoryFacts& facts, const pattern::Design& design) {
  return !are_both_ordered(facts.orders, design) &&
         std::ranges::any_of(facts.proposed, [&](const ProposedForRound& proposed) {
           return proposed.design == design && std::ranges::none_of(facts.approvals, [&](const StatedApproval& each) {
                    return each.proposal_round == proposed.round && each.design == design;
                  });
         });
}

DesignStage stage_of(const DesignState& state, bool all_complete) {
  if (state.ordered > 0 ? all_complete : state.valid > 0) return DesignStage::measured;
  if (state.printed > 0) return DesignStage::printed;
  if (state.ordered > 0) return DesignStage::approved;
  return DesignStage::pending;
}

}  // namespace

std::string_view to_string(DesignStage stage) {
  switch (stage) {
    case DesignStage::pending:
      return "pending";
    case DesignStage::rejected:
      return "rejected";
    case DesignStage::approved:
      return "approved";
    case DesignStage::printed:
      return "printed";
    case DesignStage::measured:
      return "measured";
  }
  return "pending";
}

std::vector<int> printed_for(std::span<const Order> orders, std::span<const PrintedSpecimen> printed) {
  std::vector<int> counts(orders.size(), 0);
  std::vector<const PrintedSpecimen*> free;
  for (const PrintedSpecimen& specimen : printed) {
    const auto order = std::find_if(orders.begin(), orders.end(), [&](const Order& each) {
      return !specimen.order_id.empty() && each.id == specimen.order_id;
    });
    if (order == orders.end()) {
      free.push_back(&specimen);
    } else {
      ++counts[order - orders.begin()];
    }
  }
  for (const PrintedSpecimen* specimen : free) {
    for (std::size_t i = 0; i < orders.size(); ++i) {
      if (counts[i] >= orders[i].replicates || !could_answer(*specimen, orders[i])) continue;
      ++counts[i];
      break;
    }
  }
  return counts;
}

std::optional<StatedApproval> approval_against(const LaboratoryFacts& facts, const StatedApproval& approval) {
  const auto first = std::find_if(facts.approvals.begin(), facts.approvals.end(), [&](const StatedApproval& each) {
    return each.proposal_round == approval.proposal_round && each.design == approval.design;
  });
  if (first == facts.approvals.end() || first->approved == approval.approved) return std::nullopt;
  return *first;
}

std::optional<std::string> why_void(const LaboratoryFacts& facts, const StatedApproval& approval,
                                    bool asks_for_approvals) {
  const std::string name = approval.design.name();
  if (approval.proposal_round < 0) {
    if (!approval.approved)
      return fmt::format("{}: a design that was not proposed cannot be rejected; simply do not add it", name);
    if (asks_for_approvals && waits_for_approval(facts, approval.design))
      return fmt::format("{} is proposed and waits for approval: approve it in the proposal", name);
    if (are_both_ordered(facts.orders, approval.design))
      return fmt::format("{} was already ordered; the order is kept", name);
    return std::nullopt;
  }
  if (!asks_for_approvals) return "this game does not ask for approvals: proposed designs are ordered at once";
  if (!is_proposed(facts, approval)) return fmt::format("{} is not in proposal {}", name, approval.proposal_round);
  const auto first = approval_against(facts, approval);
  if (!first) return std::nullopt;
  return fmt::format("{} was already {} by {}, which is kept", name, first->approved ? "approved" : "rejected",
                     first->by);
}

measurement::ConsistencySettings consistency_settings(const LaboratoryFacts& facts) {
  measurement::ConsistencySettings settings;
  if (facts.replicates > 0) settings.fewest_tested = facts.replicates;
  settings.fewest_consistent =
      facts.enough_valid > 0 ? facts.enough_valid : std::min(settings.fewest_consistent, settings.fewest_tested);
  return settings;
}

std::vector<DesignState> design_states(const LaboratoryFacts& facts) {
  std::map<std::string, DesignState> states;
  const auto state_of = [&](const pattern::Design& design) -> DesignState& {
    DesignState& state = states[design.name()];
    state.design = design;
    return state;
  };
  for (const ProposedForRound& proposed : facts.proposed) state_of(proposed.design).round = proposed.round;
  std::map<std::string, bool> all_complete;
  const std::vector<OrderProgress> progress = facts.book.progress(facts.orders, facts.enough_valid);
  for (std::size_t i = 0; i < facts.orders.size(); ++i) {
    const Order& order = facts.orders[i];
    state_of(order.design).ordered += order.replicates;
    const auto [entry, is_new] = all_complete.try_emplace(order.design.name(), true);
    entry->second = entry->second && progress[i].complete;
  }
  for (const PrintedSpecimen& specimen : facts.printed) ++state_of(specimen.design).printed;
  for (const measurement::SpecimenRecord& specimen : facts.book.specimens()) {
    DesignState& state = state_of(specimen.design);
    ++state.arrived;
    state.valid += specimen.valid;
  }
  for (auto& [name, state] : states) {
    state.printed = std::max(state.printed, state.arrived);  // a measured specimen was printed, reported or not
    state.stage = stage_of(state, all_complete[name]);
  }
  std::map<std::string, bool> decided;
  for (const StatedApproval& approval : facts.approvals) {
    // Without effect, as for the validation agent: an approval of an unknown proposal, or of a person's own design that
    // is proposed and waits.
    const auto known = states.find(approval.design.name());
    const bool waits = known != states.end() && known->second.stage == DesignStage::pending;
    if (approval.proposal_round >= 0 ? !is_proposed(facts, approval) : waits) continue;
    if (!decided.emplace(approval.design.name(), true).second) continue;
    DesignState& state = state_of(approval.design);
    state.decided_by = approval.by;
    state.why = approval.why;
    if (state.stage == DesignStage::pending)
      state.stage = approval.approved ? DesignStage::approved : DesignStage::rejected;
  }
  std::vector<DesignState> result;
  for (auto& [name, state] : states) result.push_back(std::move(state));
  return result;
}

}  // namespace nacre::game
