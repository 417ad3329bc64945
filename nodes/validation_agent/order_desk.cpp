#include "validation_agent/order_desk.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "game/budget.hpp"
#include "game/standings.hpp"

namespace nacre::validation_agent {
namespace {

/// A test that was made, or is to be.
std::string test_in_words(const pattern::Design& design, tester::TestKind test,
                          const tester::TestConditions& conditions) {
  return fmt::format("{}, {} test at {} degrees, {} /s, {} mm", design.name(), tester::to_string(test),
                     conditions.orientation_deg, conditions.strain_rate_per_s, conditions.thickness_mm);
}

}  // namespace

OrderDesk::OrderDesk(const game::Scenario& scenario)
    : scenario_(scenario), random_patterns_(game::random_patterns(game::within_budget(scenario, 1))) {}

game::Scenario OrderDesk::allowed() const { return game::within_budget(scenario_, round_); }

std::vector<game::Order> OrderDesk::open_game() {
  round_ = 1;
  if (scenario_.laboratory.virtual_lab || scenario_.rounds < 1) return {};
  return place(game::base_orders(allowed()));
}

std::vector<game::Order> OrderDesk::place(std::vector<game::Order> orders) {
  orders_.insert(orders_.end(), orders.begin(), orders.end());
  return orders;
}

bool OrderDesk::is_placed(const std::string& order_id) const {
  return std::ranges::find(orders_, order_id, &game::Order::id) != orders_.end();
}

bool OrderDesk::refused(const pattern::Design& design) const {
  return std::any_of(approvals_.begin(), approvals_.end(),
                     [&](const auto& entry) { return entry.first.second == design.name() && !entry.second.approved; });
}

bool OrderDesk::withdrawn(const game::DiscriminationTest& experiment) const {
  return std::ranges::any_of(orders_, [&](const game::Order& order) {
    return order.design == experiment.design && order.test == experiment.test && order.loading == experiment.loading &&
           game::fulfils(experiment.conditions, order.conditions) && withdrawals_.is_withdrawn(order.id);
  });
}

std::vector<game::Order> OrderDesk::open_round(int round, std::vector<pattern::Design> designs,
                                               std::vector<game::DiscriminationTest> experiments) {
  round_ = round;
  approval_round_ = round - 1;
  std::vector<game::Order> orders;
  const auto add = [&](std::vector<game::Order> more) {
    std::move(more.begin(), more.end(), std::back_inserter(orders));
  };
  if (round == 1) {
    add(game::opening_orders(allowed(), random_patterns_));
    std::erase_if(orders, [&](const game::Order& each) { return is_placed(each.id); });
    if (experiments.empty()) experiments = game::rotated_twins(random_patterns_, allowed().validation.replicates);
  }
  add(orders_for(approved_of(designs)));
  add(take_own(designs, orders));
  std::erase_if(experiments,
                [&](const game::DiscriminationTest& each) { return refused(each.design) || withdrawn(each); });
  if (scenario_.budget != game::BudgetSettings{}) {
    for (game::DiscriminationTest& each : experiments)
      each.replicates = std::min(each.replicates, allowed().validation.replicates);
  }
  if (scenario_.diagnosis.enabled) add(game::discrimination_orders(allowed(), round, experiments));
  return place(std::move(orders));
}

std::vector<game::Order> OrderDesk::open_family_round(int round, std::vector<pattern::Design> designs) {
  round_ = approval_round_ = round;
  is_family_round_ = true;
  std::vector<game::Order> orders = orders_for(approved_of(designs));
  std::ranges::move(take_own(designs, orders), std::back_inserter(orders));
  return place(std::move(orders));
}

/// Orders of what persons added since the last round was measured. A design that is proposed, or ordered by what opens
/// the round, needs no second one.
std::vector<game::Order> OrderDesk::take_own(const std::vector<pattern::Design>& proposed,
                                             const std::vector<game::Order>& opened) {
  std::vector<game::Order> orders;
  for (const pattern::Design& each : std::exchange(own_, {})) {
    if (std::ranges::count(proposed, each) > 0 || game::are_both_ordered(opened, each)) continue;
    std::ranges::move(game::person_orders(allowed(), round_, each), std::back_inserter(orders));
  }
  return orders;
}

/// Designs that may be ordered at once; those that a person has still to approve wait.
std::vector<pattern::Design> OrderDesk::approved_of(const std::vector<pattern::Design>& designs) {
  waiting_.clear();
  std::vector<pattern::Design> approved;
  for (const pattern::Design& design : designs) {
    const auto approval = approvals_.find({approval_round_, design.name()});
    if (!scenario_.validation.approval || (approval != approvals_.end() && approval->second.approved)) {
      approved.push_back(design);
    } else if (approval == approvals_.end()) {
      waiting_.push_back(design);
    }
  }
  return approved;
}

std::vector<game::Order> OrderDesk::orders_for(std::span<const pattern::Design> designs) const {
  return is_family_round_ ? game::family_orders(allowed(), round_, designs)
                          : game::proposal_orders(allowed(), round_, designs);
}

Result<std::vector<game::Order>> OrderDesk::take_approval(int proposal_round, const pattern::Design& design,
                                                          const Approval& approval) {
  if (!scenario_.validation.approval) return fail("this game does not ask for approvals");
  const auto [held, is_new] = approvals_.try_emplace({proposal_round, design.name()}, approval);
  if (!is_new) {
    if (held->second.approved == approval.approved) return std::vector<game::Order>{};
    return fail("{} was {} before by {}", design.name(), held->second.approved ? "approved" : "refused",
                held->second.by);
  }
  const auto waiting = std::find(waiting_.begin(), waiting_.end(), design);
  if (proposal_round != approval_round_ || waiting == waiting_.end()) return std::vector<game::Order>{};
  waiting_.erase(waiting);
  if (!approval.approved) return std::vector<game::Order>{};
  return place(orders_for(std::vector{design}));
}

Result<std::vector<game::Order>> OrderDesk::add_own(const pattern::Design& design, bool now) {
  const bool queued = std::find(own_.begin(), own_.end(), design) != own_.end();
  if (game::are_both_ordered(orders_, design) || queued) return fail("{} is ordered already", design.name());
  if (std::find(waiting_.begin(), waiting_.end(), design) != waiting_.end())
    return fail("{} is proposed and waits for its approval", design.name());
  if (now) return place(game::person_orders(allowed(), round_, design));
  own_.push_back(design);
  return std::vector<game::Order>{};
}

Result<std::vector<game::Order>> OrderDesk::take_withdrawal(const std::string& order_id,
                                                            const game::Withdrawal& withdrawal, int measured_round) {
  const auto order = std::ranges::find(orders_, order_id, &game::Order::id);
  if (order == orders_.end()) return fail("there is no order {}", order_id);
  if (order->round <= measured_round)
    return fail("round {} of order {} is measured: its model is being calibrated, or was", order->round, order_id);
  if (!withdrawals_.enter(order_id, withdrawal)) {
    const game::Withdrawal& held = *withdrawals_.of(order_id);
    if (held == withdrawal) return std::vector<game::Order>{};
    return fail("order {} was {} before by {} (revision {}): {}", order_id,
                held.withdrawn ? "withdrawn" : "given again", held.by, held.revision, held.why);
  }
  return withdrawal.withdrawn ? std::vector<game::Order>{} : std::vector{*order};
}

std::vector<game::Order> OrderDesk::open(const game::MeasurementBook& book) const {
  const auto progress = book.progress(orders_, scenario_.validation.enough_valid);
  std::vector<game::Order> open;
  for (std::size_t order = 0; order < orders_.size(); ++order)
    if (orders_[order].round == round_ && !progress[order].complete && !withdrawals_.is_withdrawn(orders_[order].id))
      open.push_back(orders_[order]);
  return open;
}

std::pair<int, int> OrderDesk::completed(const game::MeasurementBook& book) const {
  const auto progress = book.progress(orders_, scenario_.validation.enough_valid);
  int complete = 0, all = 0;
  for (std::size_t order = 0; order < orders_.size(); ++order) {
    if (orders_[order].round != round_) continue;
    complete += progress[order].complete;
    all += progress[order].complete || !withdrawals_.is_withdrawn(orders_[order].id);
  }
  return {complete, all};
}

std::optional<std::string> OrderDesk::against_label(const measurement::SpecimenRecord& specimen,
                                                    const std::string& order_id) const {
  const auto order = std::ranges::find(orders_, order_id, &game::Order::id);
  if (order == orders_.end()) return game::order_mismatch(specimen, orders_);
  if (game::fulfils(specimen, *order)) return std::nullopt;
  return fmt::format(
      "specimen {} does not fit order {}, which it names ({}): it is {}, and counts as one that nobody ordered; are "
      "labels swapped?",
      specimen.specimen, order_id, test_in_words(order->design, order->test, order->conditions),
      test_in_words(specimen.design, specimen.test, specimen.conditions));
}

std::set<pattern::Pattern> OrderDesk::settled_patterns() const {
  std::set<pattern::Pattern> patterns(random_patterns_.begin(), random_patterns_.end());
  const auto add = [&](const pattern::Design& design) {
    if (const auto pattern = game::eightfold_pattern(design)) patterns.insert(*pattern);
  };
  for (const game::Order& order : orders_) add(order.design);
  for (const pattern::Design& design : own_) add(design);
  for (const auto& [key, approval] : approvals_) {
    if (approval.approved) continue;
    if (const auto design = pattern::design_from_name(key.second)) add(*design);
  }
  return patterns;
}

}  // namespace nacre::validation_agent
