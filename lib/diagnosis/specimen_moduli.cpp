#include "diagnosis/specimen_moduli.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include "measurement/held_strain.hpp"
#include "measurement/limits.hpp"
#include "measurement/rounded.hpp"

namespace nacre::diagnosis {
namespace {

using tester::TestKind;
using Groups = std::vector<const Observation*>;

/// The least, the largest, and the middle of the widest gap between neighbours; of one value that one.
std::vector<double> telling_values(const std::set<double>& measured, bool is_logarithmic) {
  std::vector<double> values(measured.begin(), measured.end());
  if (values.size() < 2) return values;
  const auto scale = [&](double value) { return is_logarithmic ? std::log(std::max(value, 1e-3)) : value; };
  double widest = 0.0, middle = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double low = scale(values[i - 1]), high = scale(values[i]);
    if (high - low > widest) widest = high - low, middle = 0.5 * (low + high);
  }
  constexpr int kDigits = 3;
  return {values.front(), values.back(), measurement::rounded(is_logarithmic ? std::exp(middle) : middle, kDigits)};
}

/// The first, the last and the most measured of each material.
Groups told_apart_most(const Groups& groups) {
  std::map<std::string, Groups> of_material;
  for (const Observation* group : groups) of_material[group->material()].push_back(group);
  Groups chosen;
  for (const auto& [material, own] : of_material) {
    const Observation* most = *std::ranges::max_element(own, {}, &Observation::replicates);
    for (const Observation* group : {own.front(), own.back(), most})
      if (std::ranges::find(chosen, group) == chosen.end()) chosen.push_back(group);
  }
  return chosen;
}

/// A condition that may be another one.
struct Condition {
  AddedTest kind;
  bool is_logarithmic;
  std::function<std::optional<double>(const Observation&)> of;
  std::function<void(PossibleTest&, double)> set;
};

std::vector<Condition> conditions() {
  const auto noted = [](AddedTest kind, bool is_logarithmic,
                        std::optional<double> measurement::Surroundings::*member) -> Condition {
    return {kind, is_logarithmic, [member](const Observation& g) { return g.surroundings.*member; },
            [member](PossibleTest& test, double value) { test.surroundings.*member = value; }};
  };
  return {{AddedTest::at_other_rate, true,
           [](const Observation& g) { return std::optional(g.conditions.strain_rate_per_s); },
           [](PossibleTest& test, double value) { test.conditions.strain_rate_per_s = value; }},
          noted(AddedTest::at_other_temperature, false, &measurement::Surroundings::temperature_c),
          noted(AddedTest::in_other_humidity, false, &measurement::Surroundings::humidity_pct),
          noted(AddedTest::at_other_age, true, &measurement::Surroundings::age_days)};
}

/// A further test of what the group measured.
PossibleTest like(const Observation& group, AddedTest kind) {
  return {.way = {kind},
          .design = group.design,
          .test = TestKind::modulus,
          .conditions = group.conditions,
          .batch_step = group.batch_step,
          .batches = group.batches,
          .surroundings = group.surroundings,
          .machine = group.machine,
          .print_order = group.print_order,
          .is_of_measured_batch = true};
}

std::vector<PossibleTest> with_one_other_condition(const Groups& groups, const TestRules& rules) {
  std::vector<PossibleTest> tests;
  const Groups chosen = told_apart_most(groups);
  for (const Condition& condition : conditions()) {
    std::set<double> measured;
    for (const Observation* group : groups)
      if (const auto value = condition.of(*group)) measured.insert(*value);
    std::vector<double> values = telling_values(measured, condition.is_logarithmic);
    const bool is_rate = condition.kind == AddedTest::at_other_rate;
    if (!is_rate && values.size() < 2) continue;
    if (is_rate && measurement::kStrainRatePerS.hold(rules.second_rate * *measured.rbegin()))
      values.push_back(rules.second_rate * *measured.rbegin());
    for (const Observation* group : chosen) {
      if (!condition.of(*group)) continue;
      for (const double value : values) {
        tests.push_back(like(*group, condition.kind));
        condition.set(tests.back(), value);
      }
    }
  }
  return tests;
}

/// The modulus that is left after a hold, of the pulled ones.
std::vector<PossibleTest> relaxations(const Groups& groups, const TestRules& rules) {
  std::vector<PossibleTest> tests;
  for (const Observation* group : told_apart_most(groups)) {
    if (group->surroundings.held) continue;
    for (const double hold_s : rules.holds_s) {
      tests.push_back(like(*group, AddedTest::relaxation));
      tests.back().conditions.strain_rate_per_s = measurement::rounded(measurement::rate_of_hold(hold_s), 6);
      tests.back().surroundings.held = true;
    }
  }
  return tests;
}

void put_machine(PossibleTest& test, const Observations& observations, int machine) {
  test.machine = machine;
  test.surroundings.machine = observations.machines[machine];
}

std::vector<PossibleTest> on_other_machines(const Observations& observations, const Groups& groups) {
  std::vector<PossibleTest> tests;
  const int machines = static_cast<int>(observations.machines.size());
  for (const Observation* group : told_apart_most(groups)) {
    for (int machine = 0; machine < machines; ++machine) {
      if (machine == group->machine) continue;
      tests.push_back(like(*group, AddedTest::on_other_machine));
      put_machine(tests.back(), observations, machine);
    }
  }
  const UsualSurroundings usual = usual_surroundings(observations);
  for (const double share : {1.0, 0.5, 0.0}) {
    for (int machine = 1; machine < machines; ++machine) {
      tests.push_back({.way = {AddedTest::on_two_machines, machine},
                       .design = pattern::Mixture{share},
                       .test = TestKind::modulus,
                       .conditions = usual_conditions(observations, TestKind::modulus),
                       .surroundings = usual.surroundings,
                       .second_machine = machine});
      put_machine(tests.back(), observations, 0);
    }
  }
  return tests;
}

}  // namespace

std::vector<PossibleTest> moduli_of_specimens(const Observations& observations, const TestRules& rules) {
  Groups groups;
  for (const Observation& group : observations.groups) {
    if (group.design.layout()) return {};
    if (group.test == TestKind::modulus) groups.push_back(&group);
  }
  if (groups.empty()) return {};
  std::vector<PossibleTest> tests = with_one_other_condition(groups, rules);
  std::ranges::move(relaxations(groups, rules), std::back_inserter(tests));
  if (observations.machines.size() > 1)
    std::ranges::move(on_other_machines(observations, groups), std::back_inserter(tests));
  return tests;
}

}  // namespace nacre::diagnosis
