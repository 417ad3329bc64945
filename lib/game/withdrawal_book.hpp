#pragma once
// Which orders persons have withdrawn.

#include <map>
#include <string>

namespace nacre::game {

/// A person's word that an order is not to be made, or is after all.
struct Withdrawal {
  int revision = 1;
  bool withdrawn = true;
  std::string by, why;
  bool operator==(const Withdrawal&) const = default;
};

/// The highest revision of an order counts, "withdrawn" wins a tie; they may come in any order.
class WithdrawalBook {
 public:
  /// Returns whether it counts now.
  bool enter(const std::string& order_id, const Withdrawal& withdrawal);
  /// The one that counts; nullptr where there is none.
  const Withdrawal* of(const std::string& order_id) const;
  bool is_withdrawn(const std::string& order_id) const;

 private:
  std::map<std::string, Withdrawal> by_order_;
};

}  // namespace nacre::game
