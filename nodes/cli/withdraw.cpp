#include "withdraw.hpp"

#include <algorithm>
#include <optional>

#include "base/counted.hpp"
#include "base/result.hpp"
#include "design_words.hpp"
#include "laboratory_view.hpp"
#include "output.hpp"
#include "specimen_messages.hpp"
#include "wire/convert.hpp"

namespace nacre::cli {
namespace {

/// The orders that an argument means, or why there is none to change.
Result<std::vector<std::string>> orders_meant(const game::LaboratoryFacts& facts, const std::string& argument,
                                              bool withdrawn) {
  if (std::ranges::find(facts.orders, argument, &game::Order::id) != facts.orders.end()) {
    if (const auto reason = game::why_void(facts, argument, withdrawn)) return fail("{}", *reason);
    return std::vector{argument};
  }
  const pattern::Design design = pattern::design_from_argument(argument);
  if (const auto reason = game::why_void(facts, design, withdrawn)) return fail("{}", *reason);
  return game::orders_to_change(facts, design, withdrawn);
}

}  // namespace

int change_orders(const RunAccess& run, const std::vector<std::string>& designs_or_orders, const game::Withdrawal& said,
                  double timeout_s) {
  const game::LaboratoryFacts facts = view_laboratory(run).facts;
  int status = 0;
  for (const std::string& argument : designs_or_orders) {
    const auto orders = orders_meant(facts, argument, said.withdrawn);
    if (!orders) {
      remark(orders.error().message);
      status = 1;
      continue;
    }
    int changed = 0;
    for (const std::string& order : *orders) {
      const Delivered delivered = deliver(run, "approve", withdrawal_message(run, order, said), timeout_s);
      if (say_delivered(delivered, timeout_s) == 0) ++changed;
      if (!delivered.missing.empty()) return 1;
    }
    if (changed > 0)
      fmt::print("{}: {} {}\n", argument, counted(changed, "order"), said.withdrawn ? "withdrawn" : "given again");
    if (changed < std::ssize(*orders)) status = 1;
  }
  return status;
}

}  // namespace nacre::cli
