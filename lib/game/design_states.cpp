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

/// Orders of a design that are not complete.
struct Incomplete {
  int open = 0;
  const Withdrawal* withdrawn = nullptr;  ///< the last one's
};

DesignStage stage_of(const DesignState& state, const Incomplete& orders) {
  if (state.ordered > 0 && orders.open == 0)
    return orders.withdrawn != nullptr ? DesignStage::withdrawn : DesignStage::measured;
  if (state.ordered == 0 && state.valid > 0) return DesignStage::measured;
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
    case DesignStage::withdrawn:
      return "withdrawn";
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

std::vector<std::string> orders_to_change(const LaboratoryFacts& facts, const pattern::Design& design, bool withdrawn) {
  const auto progress = facts.book.progress(facts.orders, facts.enough_valid);
  int newest = 0;
  for (const Order& order : facts.orders) newest = std::max(newest, order.round);
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < facts.orders.size(); ++i) {
    const Order& order = facts.orders[i];
    if (order.round == newest && order.design == design && !progress[i].complete &&
        facts.withdrawals.is_withdrawn(order.id) != withdrawn)
      ids.push_back(order.id);
  }
  return ids;
}

std::optional<std::string> why_void(const LaboratoryFacts& facts, const std::string& order_id, bool withdrawn) {
  const auto order = std::ranges::find(facts.orders, order_id, &Order::id);
  if (order == facts.orders.end()) return fmt::format("{}: there is no such order", order_id);
  const auto progress = facts.book.progress(facts.orders, facts.enough_valid);
  if (progress[order - facts.orders.begin()].complete)
    return fmt::format("order {} is complete: its specimens are measured, and count", order_id);
  const Withdrawal* held = facts.withdrawals.of(order_id);
  const bool is_withdrawn = held != nullptr && held->withdrawn;
  if (withdrawn && is_withdrawn) return fmt::format("order {} was withdrawn by {}: {}", order_id, held->by, held->why);
  if (!withdrawn && !is_withdrawn) return fmt::format("order {} is not withdrawn", order_id);
  return std::nullopt;
}

std::optional<std::string> why_void(const LaboratoryFacts& facts, const pattern::Design& design, bool withdrawn) {
  if (!orders_to_change(facts, design, withdrawn).empty()) return std::nullopt;
  const std::string name = design.name();
  if (!withdrawn) return fmt::format("{}: none of its orders of the newest round is withdrawn", name);
  if (waits_for_approval(facts, design)) return fmt::format("{} waits for approval: reject it instead", name);
  const auto states = design_states(facts);
  const auto state = std::ranges::find(states, design, &DesignState::design);
  if (state == states.end()) return fmt::format("{} is not ordered", name);
  if (state->ordered == 0 && state->stage == DesignStage::approved)
    return fmt::format("{} is not ordered yet: withdraw it when the next round has begun", name);
  return fmt::format("{}: no order of it is open: it is {}", name, to_string(state->stage));
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
  std::map<std::string, Incomplete> incomplete;
  const std::vector<OrderProgress> progress = facts.book.progress(facts.orders, facts.enough_valid);
  for (std::size_t i = 0; i < facts.orders.size(); ++i) {
    const Order& order = facts.orders[i];
    state_of(order.design).ordered += order.replicates;
    if (progress[i].complete) continue;
    Incomplete& orders = incomplete[order.design.name()];
    if (facts.withdrawals.is_withdrawn(order.id)) {
      orders.withdrawn = facts.withdrawals.of(order.id);
    } else {
      ++orders.open;
    }
  }
  for (const PrintedSpecimen& specimen : facts.printed) ++state_of(specimen.design).printed;
  for (const measurement::SpecimenRecord& specimen : facts.book.specimens()) {
    DesignState& state = state_of(specimen.design);
    ++state.arrived;
    state.valid += specimen.valid;
  }
  for (auto& [name, state] : states) {
    state.printed = std::max(state.printed, state.arrived);  // a measured specimen was printed, reported or not
    state.stage = stage_of(state, incomplete[name]);
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
  for (auto& [name, state] : states) {
    if (state.stage == DesignStage::withdrawn) {
      state.decided_by = incomplete[name].withdrawn->by;
      state.why = incomplete[name].withdrawn->why;
    }
    result.push_back(std::move(state));
  }
  return result;
}

}  // namespace nacre::game
