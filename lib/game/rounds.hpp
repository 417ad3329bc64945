#pragma once
// The orders of each round.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "game/scenario.hpp"
#include "pattern/design.hpp"
#include "tester/loading.hpp"
#include "tester/simulation.hpp"

namespace nacre::game {

enum class OrderReason { base, mixture, random, proposal, discrimination, person, family };
std::string_view to_string(OrderReason reason);
Result<OrderReason> order_reason_from_string(std::string_view text);

/// Replicates of one design for one test.
struct Order {
  std::string id;  ///< unique within the run, see order_id()
  int round = 0;
  pattern::Design design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::TestConditions conditions = {};
  tester::Loading loading = {};  ///< of a coupon
  int replicates = 0;
  std::string batch;
  OrderReason reason = OrderReason::proposal;
};

/// A test that discriminates between rival causes (diagnosis), before it gets an order number.
struct DiscriminationTest {
  pattern::Design design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::TestConditions conditions = {};
  tester::Loading loading = {};  ///< of a coupon
  int replicates = 0;
};

/// `rN/DESIGN/TEST`, with `/turned` for orientation 90.
std::string order_id(int round, const pattern::Design& design, tester::TestKind test,
                     const tester::TestConditions& conditions);

/// The stratified random patterns that round 1 measures.
std::vector<pattern::Pattern> random_patterns(const Scenario& scenario);

/// Modulus and toughness orders of the pure materials and the interface material.
std::vector<Order> base_orders(const Scenario& scenario);

/// base_orders() and those of the scenario's mixtures and the random patterns: measured in round 1 with the first
/// proposals. A mixture named twice (0.5 is the interface material) is ordered once.
std::vector<Order> opening_orders(const Scenario& scenario, std::span<const pattern::Pattern> random_patterns);

/// Modulus and toughness orders of designs proposed for `round`.
std::vector<Order> proposal_orders(const Scenario& scenario, int round, std::span<const pattern::Design> designs);

/// Modulus and toughness orders of variants chosen from families, in the round after the game's last.
std::vector<Order> family_orders(const Scenario& scenario, int round, std::span<const pattern::Design> designs);

/// Modulus and toughness orders of a design that a person wants measured.
std::vector<Order> person_orders(const Scenario& scenario, int round, const pattern::Design& design);

/// At most diagnosis.discrimination_orders of the experiments; equal experiments are ordered once.
std::vector<Order> discrimination_orders(const Scenario& scenario, int round,
                                         std::span<const DiscriminationTest> experiments);

/// The experiments of round 1, when there is no diagnosis yet: modulus tests of the patterns with the longest
/// interface, printed turned by 90 degrees, to see whether the printer's axes matter.
std::vector<DiscriminationTest> rotated_twins(std::span<const pattern::Pattern> patterns, int replicates);

/// Whether a specimen tested under `tested` fulfils an order for `ordered`: same orientation, rate within a quarter,
/// thickness within a tenth (callipers never read exactly 3.2).
bool fulfils(const tester::TestConditions& tested, const tester::TestConditions& ordered);

/// Whether E and T of the design itself are ordered: not only one of them, or a twin that is turned or pulled faster.
bool are_both_ordered(std::span<const Order> orders, const pattern::Design& design);

}  // namespace nacre::game
