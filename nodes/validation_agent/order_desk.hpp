#pragma once
// What is ordered from the laboratory in the present round, and what a person approves of it.

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "game/measurement_book.hpp"
#include "game/rounds.hpp"
#include "game/scenario.hpp"
#include "game/withdrawal_book.hpp"

namespace nacre::validation_agent {

/// A person's yes or no to a proposed design.
struct Approval {
  bool approved = false;
  std::string by;
  std::string why;
};

/// The orders of the game. The orders of a round depend on the proposal, the approvals and the experiments wanted, not
/// on when an approval came.
class OrderDesk {
 public:
  explicit OrderDesk(const game::Scenario& scenario);

  /// The orders that wait for no search: a person can print and test the base materials of round 1 while the first one
  /// goes on. None for the virtual laboratory, whose tests would take the search's cores.
  std::vector<game::Order> open_game();

  /// Opens a round: `designs` proposed for it, `experiments` that the diagnosis wants. Returns the orders that can go
  /// out at once.
  std::vector<game::Order> open_round(int round, std::vector<pattern::Design> designs,
                                      std::vector<game::DiscriminationTest> experiments);

  /// Opens the round of the family stage: designs chosen of families, which a person approves under the number of this
  /// round, and what persons added meanwhile. Returns the orders that can go out at once.
  std::vector<game::Order> open_family_round(int round, std::vector<pattern::Design> designs);

  /// An approval of a design of the proposal of `proposal_round`, before or after that round is opened. The first one
  /// counts: its order may be in print. Returns orders that go out because of it, or why the approval changes nothing.
  Result<std::vector<game::Order>> take_approval(int proposal_round, const pattern::Design& design,
                                                 const Approval& approval);

  /// A person wants a design of their own measured too: in the open round while it is being measured (`now`), else in
  /// the next one. Returns orders that go out at once, or why there are none.
  Result<std::vector<game::Order>> add_own(const pattern::Design& design, bool now);

  /// An order is not to be made, or is after all: its round closes without it, or waits for it. What was measured of it
  /// counts all the same. `measured_round`: the last one that is measured; its orders stay. Returns the orders to be
  /// given again, or why it changes nothing.
  Result<std::vector<game::Order>> take_withdrawal(const std::string& order_id, const game::Withdrawal& withdrawal,
                                                   int measured_round);

  /// Number of proposed designs of the open round that still wait for a person.
  int awaiting_approval() const { return waiting_.size(); }

  /// Designs of persons that wait for the next round.
  const std::vector<pattern::Design>& own() const { return own_; }

  /// Orders of all rounds.
  const std::vector<game::Order>& orders() const { return orders_; }

  /// Orders of the open round that are neither complete nor withdrawn.
  std::vector<game::Order> open(const game::MeasurementBook& book) const;

  /// Orders of the open round that are complete, and how many there are, without those that were withdrawn before.
  std::pair<int, int> completed(const game::MeasurementBook& book) const;

  /// Why a specimen does not count for the order whose id it carries, or for that of its design and test, as a
  /// sentence; nothing where it does, and where the desk has no such order.
  std::optional<std::string> against_label(const measurement::SpecimenRecord& specimen,
                                           const std::string& order_id) const;

  /// Patterns ordered or to be ordered whatever happens, and those that a person refused: not worth proposing again.
  std::set<pattern::Pattern> settled_patterns() const;

 private:
  std::vector<game::Order> place(std::vector<game::Order> orders);
  std::vector<game::Order> take_own(const std::vector<pattern::Design>& proposed,
                                    const std::vector<game::Order>& opened);
  std::vector<pattern::Design> approved_of(const std::vector<pattern::Design>& designs);
  std::vector<game::Order> orders_for(std::span<const pattern::Design> designs) const;
  bool refused(const pattern::Design& design) const;
  /// Whether an order of the same test was withdrawn.
  bool withdrawn(const game::DiscriminationTest& experiment) const;
  bool is_placed(const std::string& order_id) const;
  /// The scenario as the budget allows the present round.
  game::Scenario allowed() const;

  game::Scenario scenario_;
  std::vector<pattern::Pattern> random_patterns_;
  int round_ = 0;
  int approval_round_ = -1;               // round that approvals of the open round's designs name
  bool is_family_round_ = false;          // the open one
  std::vector<pattern::Design> waiting_;  // of the open round, not yet approved or refused
  std::vector<pattern::Design> own_;      // of persons, for the next round
  std::vector<game::Order> orders_;
  std::map<std::pair<int, std::string>, Approval> approvals_;  // by round of the proposal and design
  game::WithdrawalBook withdrawals_;
};

}  // namespace nacre::validation_agent
