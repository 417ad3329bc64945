#include "diagnosis/possible_tests.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <set>

#include "diagnosis/factors.hpp"
#include "diagnosis/specimen_moduli.hpp"
#include "measurement/conditions.hpp"
#include "measurement/held_strain.hpp"
#include "measurement/rounded.hpp"
#include "pattern/coupons.hpp"

namespace nacre::diagnosis {
namespace {

using tester::TestKind;

constexpr double kCouponStrain = 0.02;  // also in in_words(PossibleTest)
constexpr std::string_view kBatchToCome = "a batch to come";
constexpr double kCouponStep = kCouponStrain / 40.0;

/// Groups of layouts that are not coupons, those of most replicates first.
std::vector<const Observation*> layouts_most_measured_first(const Observations& observations) {
  std::vector<const Observation*> groups;
  for (const Observation& g : observations.groups)
    if (g.design.layout() && g.test != TestKind::tensile) groups.push_back(&g);
  std::ranges::stable_sort(groups, std::greater<>(), &Observation::replicates);
  return groups;
}

/// A rate that was not measured yet.
struct OtherRate {
  double strain_rate_per_s = 0.0;
  AddedTest twin, coupon;  ///< of layouts and of coupons at it
};

/// Ten times the usual rate, and where measured rates lie far apart the middle of the widest gap: relaxation with a
/// time in between shows there.
std::vector<OtherRate> other_rates(const Observations& observations, TestKind test, double usual_per_s,
                                   const TestRules& rules) {
  std::vector<OtherRate> rates = {{rules.second_rate * usual_per_s, AddedTest::faster_twin, AddedTest::faster_coupon}};
  std::set<double> measured;
  for (const Observation& g : observations.groups)
    if (g.test == test) measured.insert(g.conditions.strain_rate_per_s);
  double widest = rules.far_apart, middle = 0.0;
  for (auto rate = measured.begin(); rate != measured.end() && std::next(rate) != measured.end(); ++rate)
    if (const double gap = *std::next(rate) / *rate; gap > widest) widest = gap, middle = *rate * std::sqrt(gap);
  if (middle > 0.0) rates.push_back({middle, AddedTest::twin_between_rates, AddedTest::coupon_between_rates});
  return rates;
}

/// Turned twins of all layouts; faster and thinner ones of the most measured of each test.
std::vector<PossibleTest> twins(const Observations& observations, const TestRules& rules) {
  std::vector<PossibleTest> possible;
  const std::vector<const Observation*> layouts = layouts_most_measured_first(observations);
  std::map<TestKind, int> twins_of;
  for (const Observation* g : layouts) {
    const auto twin = [&](AddedTest kind) -> tester::TestConditions& {
      possible.push_back({.way = {kind},
                          .design = g->design,
                          .test = g->test,
                          .conditions = g->conditions,
                          .surroundings = g->surroundings,
                          .machine = g->machine});
      return possible.back().conditions;
    };
    const double orientation_deg = g->conditions.orientation_deg;
    twin(AddedTest::turned_twin).orientation_deg = orientation_deg == 0.0 ? 90.0 : 0.0;
    if (g->conditions != usual_conditions(observations, g->test) || twins_of[g->test]++ >= rules.condition_twins)
      continue;
    for (const OtherRate& rate : other_rates(observations, g->test, g->conditions.strain_rate_per_s, rules))
      twin(rate.twin).strain_rate_per_s = rate.strain_rate_per_s;
    twin(AddedTest::thinner_twin).thickness_mm *= rules.second_thickness;
  }
  return possible;
}

std::vector<PossibleTest> layout_coupons(TestKind test, const tester::TestConditions& conditions) {
  std::vector<PossibleTest> possible;
  const auto laminate = [&](pattern::LayerDirection direction, int period, AddedTest kind) {
    possible.push_back({{kind, period}, pattern::laminate(direction, period, period), test, conditions});
  };
  for (const int period : {1, 2, 5}) {
    possible.push_back({{AddedTest::checkerboard, period}, pattern::checkerboard(period), test, conditions});
    laminate(pattern::LayerDirection::along_x, period, AddedTest::laminate_across);
    laminate(pattern::LayerDirection::along_y, period, AddedTest::laminate_along);
  }
  return possible;
}

std::vector<PossibleTest> homogeneous_coupons(const Observations& observations, const TestRules& rules) {
  const tester::TestConditions usual = usual_conditions(observations, TestKind::tensile);
  std::vector<OtherRate> rates = other_rates(observations, TestKind::tensile, usual.strain_rate_per_s, rules);
  rates.insert(rates.begin(), {usual.strain_rate_per_s, AddedTest::turned_twin, AddedTest::coupon});
  std::vector<PossibleTest> possible;
  for (const double fraction : {1.0, 0.5, 0.0}) {
    for (const OtherRate& rate : rates) {
      possible.push_back({{rate.coupon}, pattern::Mixture{fraction}, TestKind::tensile, usual});
      possible.back().conditions.strain_rate_per_s = rate.strain_rate_per_s;
    }
  }
  return possible;
}

/// A pull as far as the others, held, unloaded to zero force and left as long: what is viscous relaxes and recovers,
/// what is plastic stays.
std::vector<PossibleTest> paused_coupons(const Observations& observations, const TestRules& rules) {
  std::vector<PossibleTest> possible;
  for (const double fraction : {1.0, 0.5, 0.0}) {
    for (const double hold_s : rules.holds_s) {
      possible.push_back({.way = {AddedTest::paused_coupon},
                          .design = pattern::Mixture{fraction},
                          .test = TestKind::tensile,
                          .conditions = usual_conditions(observations, TestKind::tensile),
                          .pauses = {{kCouponStrain}, {hold_s}, hold_s}});
    }
  }
  return possible;
}

/// Notched homogeneous specimens: their crack has one way to go.
std::vector<PossibleTest> notched_specimens(const Observations& observations) {
  std::vector<PossibleTest> possible;
  for (const double fraction : {1.0, 0.75, 0.5, 0.0})
    possible.push_back({.way = {AddedTest::notched},
                        .design = pattern::Mixture{fraction},
                        .test = TestKind::toughness,
                        .conditions = usual_conditions(observations, TestKind::toughness)});
  return possible;
}

/// Whether pieces of measured specimens would stand beside others that were printed in another batch or at another
/// time: what the group owes to either shows there.
bool is_of_other_history(const PossibleTest& test, const Observation& group) {
  if (!test.is_of_measured_batch) return false;
  const bool in_its_batches =
      std::ranges::all_of(test.batches, [&](const auto& batch) { return group.batches.contains(batch.first); });
  return !in_its_batches || test.print_order != group.print_order;
}

}  // namespace

bool is_told_by_modulus(const PossibleTest& test) {
  return test.test == TestKind::toughness && test.way.kind != AddedTest::notched && !is_twin(test.way.kind);
}

bool is_twin(AddedTest kind) { return kind <= AddedTest::thinner_twin; }

tester::Loading coupon_loading() { return {{kCouponStrain, 0.005, 0.022}}; }

std::vector<double> unload_history() { return tester::strain_path(coupon_loading(), kCouponStep); }

std::vector<double> strains_of(const tester::Loading& pauses) {
  return pauses.has_pauses() ? tester::strain_path({{pauses.turns.front()}}, kCouponStep) : unload_history();
}

bool would_join(const PossibleTest& test, const Observation& group) {
  return test.test == group.test && test.design == group.design &&
         measurement::same_conditions(test.conditions, group.conditions) &&
         measurement::nominal_surroundings(test.surroundings) ==
             measurement::nominal_surroundings(group.surroundings) &&
         test.pauses == group.pauses && (test.test != TestKind::tensile || test.pauses.has_pauses() || group.unloaded);
}

std::optional<double> hold_of(const PossibleTest& test) {
  if (!test.pauses.holds_s.empty()) return test.pauses.holds_s.front();
  constexpr int kDigits = 3;
  if (!test.surroundings.held) return std::nullopt;
  return measurement::rounded(measurement::rate_of_hold(test.conditions.strain_rate_per_s), kDigits);
}

Observation group_of(const PossibleTest& test, int replicates) {
  Observation group;
  group.design = test.design;
  group.test = test.test;
  group.conditions = test.conditions;
  group.unloaded = test.test == TestKind::tensile && !test.pauses.has_pauses();
  group.pauses = test.pauses;
  group.replicates = replicates;
  group.batch_step = test.batch_step;
  group.batches = test.batches;
  if (group.batches.empty() && test.batch_step > 0.0) group.batches = {{std::string(kBatchToCome), replicates}};
  group.surroundings = test.surroundings;
  group.machine = test.machine;
  group.print_order = test.print_order;
  return group;
}

UsualSurroundings usual_surroundings(const Observations& observations) {
  std::map<std::string, std::pair<int, const Observation*>> counts;
  for (const Observation& group : observations.groups) {
    auto& [count, first] = counts[measurement::nominal_surroundings(group.surroundings)];
    if (count++ == 0) first = &group;
  }
  const auto most = std::ranges::max_element(counts, {}, [](const auto& each) { return each.second.first; });
  if (most == counts.end()) return {};
  UsualSurroundings usual{most->second.second->surroundings, most->second.second->machine};
  usual.surroundings.held = false;
  return usual;
}

std::vector<PossibleTest> possible_tests(const Observations& observations, const TestRules& rules) {
  std::vector<PossibleTest> possible;
  for (const TestKind test : {TestKind::modulus, TestKind::toughness})
    if (std::ranges::any_of(observations.groups,
                            [&](const Observation& g) { return g.test == test && g.design.layout(); }))
      std::ranges::move(layout_coupons(test, usual_conditions(observations, test)), std::back_inserter(possible));
  std::ranges::move(homogeneous_coupons(observations, rules), std::back_inserter(possible));
  if (!has_layouts(observations)) std::ranges::move(paused_coupons(observations, rules), std::back_inserter(possible));
  if (observations.has(TestKind::toughness))
    std::ranges::move(notched_specimens(observations), std::back_inserter(possible));
  const UsualSurroundings usual = usual_surroundings(observations);
  for (PossibleTest& test : possible) test.surroundings = usual.surroundings, test.machine = usual.machine;
  std::vector<PossibleTest> of_measured = twins(observations, rules);
  possible.insert(possible.begin(), of_measured.begin(), of_measured.end());
  std::ranges::move(moduli_of_specimens(observations, rules), std::back_inserter(possible));
  std::vector<PossibleTest> left;
  for (PossibleTest& test : possible) {
    const bool measured = !test.second_machine && std::ranges::any_of(observations.groups, [&](const Observation& g) {
      return would_join(test, g) && !is_of_other_history(test, g);
    });
    const bool listed = std::ranges::any_of(left, [&](const PossibleTest& other) {
      const bool is_of_its_batch =
          test.is_of_measured_batch == other.is_of_measured_batch &&
          (!test.is_of_measured_batch || (test.batches == other.batches && test.batch_step == other.batch_step &&
                                          test.print_order == other.print_order));
      return test.second_machine == other.second_machine && is_of_its_batch && would_join(test, group_of(other, 1));
    });
    if (measured || listed) continue;
    left.push_back(std::move(test));
    if (observations.last_batch_step == 0.0 || left.back().is_of_measured_batch) continue;
    left.back().batch_step = observations.last_batch_step + 1.0;
  }
  return left;
}

}  // namespace nacre::diagnosis
