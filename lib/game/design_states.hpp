#pragma once
// The stage of each design between proposal and measurement, as a laboratory needs it. Nothing is stored here: the
// states follow from approvals, orders, prints and measurements, so that they survive every restart.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "game/measurement_book.hpp"
#include "game/withdrawal_book.hpp"
#include "measurement/consistency.hpp"
#include "tester/names.hpp"

namespace nacre::game {

enum class DesignStage {
  pending,    ///< proposed, waiting for a person's approval or for its round
  rejected,   ///< by a person
  approved,   ///< ordered: to be printed
  printed,    ///< some specimens are printed, not all orders are complete
  measured,   ///< every order is complete, or it was measured without one
  withdrawn,  ///< by a person: what is not complete of its orders is not made
};
std::string_view to_string(DesignStage stage);

/// A person's approval or rejection of a design.
struct StatedApproval {
  int proposal_round = 0;
  pattern::Design design;
  bool approved = false;
  std::string by;
  std::string why;
};

/// A specimen that came out of a printer.
struct PrintedSpecimen {
  std::string label;
  pattern::Design design;
  tester::TestKind test = tester::TestKind::modulus;
  double orientation_deg = 0.0;
  std::string order_id;  ///< empty when it was not ordered
  bool operator==(const PrintedSpecimen&) const = default;
};

struct ProposedForRound {
  int round = 0;
  pattern::Design design;
};

/// All that is known of the laboratory's work.
struct LaboratoryFacts {
  std::vector<ProposedForRound> proposed;
  std::vector<StatedApproval> approvals;  ///< in the order of arrival: the first valid one counts
  std::vector<Order> orders;
  WithdrawalBook withdrawals;  ///< of these orders
  std::vector<PrintedSpecimen> printed;
  MeasurementBook book;
  int replicates = 0;    ///< of the scenario
  int enough_valid = 0;  ///< of the scenario
};

/// When replicates are enough: as many as the game orders, of which `enough_valid` agree, or three as in the thesis
/// where the scenario sets none, or all of fewer.
measurement::ConsistencySettings consistency_settings(const LaboratoryFacts& facts);

/// One design and its specimens, all tests together.
struct DesignState {
  pattern::Design design;
  DesignStage stage = DesignStage::pending;
  int round = -1;  ///< of the proposal; -1: not proposed by nacre
  int ordered = 0, printed = 0, arrived = 0, valid = 0;
  std::string decided_by, why;

  /// As in `nacre designs --json` and on the dashboard.
  static void fields(auto& field, auto& m) {
    field("design", m.design);
    field("state", to_string(m.stage));
    field("proposed_in_round", m.round < 0 ? std::nullopt : std::optional<int>(m.round));
    field("ordered", m.ordered);
    field("printed", m.printed);
    field("measured", m.arrived);
    field("valid", m.valid);
    field("by", m.decided_by);
    field("why", m.why);
  }
};

/// Designs by name. Homogeneous ones, coupons and designs that a person brought are among them.
std::vector<DesignState> design_states(const LaboratoryFacts& facts);

/// The approval that counts in place of this one: the first on the same design of the same proposal, when it is the
/// opposite. Nothing where this one may count.
std::optional<StatedApproval> approval_against(const LaboratoryFacts& facts, const StatedApproval& approval);

/// Why an approval would have no effect, as a sentence; nothing where it counts. `asks_for_approvals`: the game does.
std::optional<std::string> why_void(const LaboratoryFacts& facts, const StatedApproval& approval,
                                    bool asks_for_approvals);

/// The orders of a design that a person can withdraw now (`withdrawn`), or give again: those of the newest round that
/// are not complete.
std::vector<std::string> orders_to_change(const LaboratoryFacts& facts, const pattern::Design& design, bool withdrawn);

/// Why withdrawing an order, or giving it again, would have no effect, as a sentence; nothing where it counts.
std::optional<std::string> why_void(const LaboratoryFacts& facts, const std::string& order_id, bool withdrawn);

/// The same of all orders of a design: why there is none to withdraw, or to give again.
std::optional<std::string> why_void(const LaboratoryFacts& facts, const pattern::Design& design, bool withdrawn);

/// Printed specimens of each order: those with its id, then those that fit and have none.
std::vector<int> printed_for(std::span<const Order> orders, std::span<const PrintedSpecimen> printed);

}  // namespace nacre::game
