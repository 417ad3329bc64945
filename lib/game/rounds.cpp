#include "game/rounds.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/ranges.h>

#include "base/random.hpp"
#include "measurement/conditions.hpp"
#include "pattern/random_pattern.hpp"

namespace nacre::game {
namespace {

using pattern::Design;
using tester::TestKind;

void order_both_tests(std::vector<Order>& orders, const Scenario& scenario, int round, const Design& design,
                      OrderReason reason) {
  for (TestKind test : {TestKind::modulus, TestKind::toughness}) {
    orders.push_back({.id = order_id(round, design, test, {}),
                      .round = round,
                      .design = design,
                      .test = test,
                      .conditions = {},
                      .replicates = scenario.validation.replicates,
                      .batch = fmt::format("round-{}", round),
                      .reason = reason});
  }
}

// Pairs of unlike neighbouring pixels in the periodic tile.
int interface_length(const pattern::Pattern& pattern) {
  int length = 0;
  for (int row = 0; row < pattern::kSide; ++row) {
    for (int column = 0; column < pattern::kSide; ++column) {
      const bool here = pattern.rigid(row, column);
      length += here != pattern.rigid((row + 1) % pattern::kSide, column);
      length += here != pattern.rigid(row, (column + 1) % pattern::kSide);
    }
  }
  return length;
}

constexpr std::pair<OrderReason, std::string_view> kReasons[] = {
    {OrderReason::base, "base"},
    {OrderReason::mixture, "mixture"},
    {OrderReason::random, "random"},
    {OrderReason::proposal, "proposal"},
    {OrderReason::discrimination, "discrimination"},
    {OrderReason::person, "person"},
    {OrderReason::family, "family"},
};

}  // namespace

std::string_view to_string(OrderReason reason) {
  return std::ranges::find(kReasons, reason, &std::pair<OrderReason, std::string_view>::first)->second;
}

Result<OrderReason> order_reason_from_string(std::string_view text) {
  std::vector<std::string_view> known;
  for (const auto& [reason, name] : kReasons) {
    if (name == text) return reason;
    known.push_back(name);
  }
  return fail("reason '{}': expected one of {}", text, fmt::join(known, ", "));
}

std::string order_id(int round, const Design& design, TestKind test, const tester::TestConditions& conditions) {
  const bool turned = std::abs(conditions.orientation_deg - 90.0) < 0.5;
  return fmt::format("r{}/{}/{}{}", round, design.name(), tester::to_string(test), turned ? "/turned" : "");
}

std::vector<pattern::Pattern> random_patterns(const Scenario& scenario) {
  RandomStream random(scenario.seed, "stratified random patterns");
  return pattern::stratified_patterns(scenario.validation.random_patterns, random);
}

std::vector<Order> base_orders(const Scenario& scenario) {
  std::vector<Order> orders;
  for (double fraction : {0.0, 0.5, 1.0})
    order_both_tests(orders, scenario, 1, pattern::Mixture{fraction}, OrderReason::base);
  return orders;
}

std::vector<Order> opening_orders(const Scenario& scenario, std::span<const pattern::Pattern> random_patterns) {
  std::vector<Order> orders = base_orders(scenario);
  std::set<std::string> homogeneous;
  for (const Order& order : orders) homogeneous.insert(order.design.name());
  for (double fraction : scenario.validation.mixtures) {
    const Design design = pattern::Mixture{fraction};
    if (homogeneous.insert(design.name()).second) order_both_tests(orders, scenario, 1, design, OrderReason::mixture);
  }
  for (const pattern::Pattern& random : random_patterns) {
    order_both_tests(orders, scenario, 1, random, OrderReason::random);
  }
  return orders;
}

std::vector<Order> proposal_orders(const Scenario& scenario, int round, std::span<const Design> designs) {
  std::vector<Order> orders;
  for (const Design& design : designs) order_both_tests(orders, scenario, round, design, OrderReason::proposal);
  return orders;
}

std::vector<Order> family_orders(const Scenario& scenario, int round, std::span<const Design> designs) {
  std::vector<Order> orders;
  for (const Design& design : designs) order_both_tests(orders, scenario, round, design, OrderReason::family);
  return orders;
}

std::vector<Order> person_orders(const Scenario& scenario, int round, const Design& design) {
  std::vector<Order> orders;
  order_both_tests(orders, scenario, round, design, OrderReason::person);
  for (Order& order : orders) order.id += "/person";
  return orders;
}

std::vector<Order> discrimination_orders(const Scenario& scenario, int round,
                                         std::span<const DiscriminationTest> experiments) {
  std::vector<Order> orders;
  for (const DiscriminationTest& experiment : experiments) {
    if (static_cast<int>(orders.size()) >= scenario.diagnosis.discrimination_orders) break;
    const auto same_test = [&](const Order& order) {
      return order.design == experiment.design && order.test == experiment.test &&
             order.loading == experiment.loading && fulfils(experiment.conditions, order.conditions);
    };
    if (std::any_of(orders.begin(), orders.end(), same_test)) continue;
    // The number keeps the id apart from a proposal's and from the same design's at another rate or thickness.
    orders.push_back({.id = fmt::format("{}/discrimination-{}",
                                        order_id(round, experiment.design, experiment.test, experiment.conditions),
                                        orders.size() + 1),
                      .round = round,
                      .design = experiment.design,
                      .test = experiment.test,
                      .conditions = experiment.conditions,
                      .loading = experiment.loading,
                      .replicates = experiment.replicates > 0 ? experiment.replicates : scenario.validation.replicates,
                      .batch = fmt::format("round-{}", round),
                      .reason = OrderReason::discrimination});
  }
  return orders;
}

std::vector<DiscriminationTest> rotated_twins(std::span<const pattern::Pattern> patterns, int replicates) {
  std::vector<pattern::Pattern> ordered(patterns.begin(), patterns.end());
  std::sort(ordered.begin(), ordered.end(), [](const pattern::Pattern& a, const pattern::Pattern& b) {
    const int length_a = interface_length(a);
    const int length_b = interface_length(b);
    return length_a != length_b ? length_a > length_b : a < b;
  });
  std::vector<DiscriminationTest> experiments;
  for (const pattern::Pattern& each : ordered) {
    experiments.push_back(
        {.design = each, .test = TestKind::modulus, .conditions = {.orientation_deg = 90.0}, .replicates = replicates});
  }
  return experiments;
}

bool fulfils(const tester::TestConditions& tested, const tester::TestConditions& ordered) {
  return measurement::same_conditions(tested, ordered);
}

bool are_both_ordered(std::span<const Order> orders, const pattern::Design& design) {
  const auto is_ordered = [&](tester::TestKind test) {
    return std::ranges::any_of(orders, [&](const Order& order) {
      return order.design == design && order.test == test && fulfils(order.conditions, {});
    });
  };
  return is_ordered(tester::TestKind::modulus) && is_ordered(tester::TestKind::toughness);
}

}  // namespace nacre::game
