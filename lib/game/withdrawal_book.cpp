#include "game/withdrawal_book.hpp"

#include <utility>

namespace nacre::game {

bool WithdrawalBook::enter(const std::string& order_id, const Withdrawal& withdrawal) {
  const auto [position, is_new] = by_order_.try_emplace(order_id, withdrawal);
  if (is_new) return true;
  const auto rank = [](const Withdrawal& each) { return std::pair(each.revision, each.withdrawn); };
  if (rank(withdrawal) <= rank(position->second)) return false;
  position->second = withdrawal;
  return true;
}

const Withdrawal* WithdrawalBook::of(const std::string& order_id) const {
  const auto found = by_order_.find(order_id);
  return found == by_order_.end() ? nullptr : &found->second;
}

bool WithdrawalBook::is_withdrawn(const std::string& order_id) const {
  const Withdrawal* counts = of(order_id);
  return counts != nullptr && counts->withdrawn;
}

}  // namespace nacre::game
