#include "game/budget.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/random.hpp"
#include "pattern/random_pattern.hpp"

namespace nacre::game {
namespace {

constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();
constexpr int kBaseMaterials = 3, kTestsOfADesign = 2;

bool is_base(double rigid_fraction) { return rigid_fraction == 0.0 || rigid_fraction == 0.5 || rigid_fraction == 1.0; }

int further_mixtures(const Scenario& scenario) {
  return static_cast<int>(std::ranges::count_if(scenario.validation.mixtures, [](double f) { return !is_base(f); }));
}

bool is_first(int round) { return round <= 1; }

std::int64_t specimens_of(const Scenario& scenario, int round) {
  std::int64_t designs = scenario.proposal.designs;
  if (is_first(round)) designs += kBaseMaterials + scenario.validation.random_patterns + further_mixtures(scenario);
  const int discrimination = scenario.diagnosis.enabled ? scenario.diagnosis.discrimination_orders : 0;
  return scenario.validation.replicates * (kTestsOfADesign * designs + discrimination);
}

/// Takes away the next thing that is given up. Returns whether anything was left to take.
bool give_up_one(Scenario& scenario, int round) {
  if (scenario.diagnosis.enabled && scenario.diagnosis.discrimination_orders > 0) {
    --scenario.diagnosis.discrimination_orders;
  } else if (is_first(round) && further_mixtures(scenario) > 0) {
    auto& mixtures = scenario.validation.mixtures;
    mixtures.erase(std::find_if_not(mixtures.rbegin(), mixtures.rend(), is_base).base() - 1);
  } else if (is_first(round) && scenario.validation.random_patterns > 0) {
    --scenario.validation.random_patterns;
  } else if (scenario.proposal.designs > 1) {
    --scenario.proposal.designs;
  } else {
    return false;
  }
  return true;
}

Scenario reduced(Scenario scenario, int round, std::int64_t limit) {
  while (specimens_of(scenario, round) > limit && give_up_one(scenario, round)) {
  }
  return scenario;
}

/// Specimens of all rounds, none with more than `limit` where it can do with less.
std::int64_t specimens_of_all(const Scenario& scenario, std::int64_t limit) {
  if (scenario.rounds < 1) return 0;
  return specimens_of(reduced(scenario, 1, limit), 1) +
         (scenario.rounds - 1) * specimens_of(reduced(scenario, 2, limit), 2);
}

Scenario with_replicates(Scenario scenario, int replicates) {
  scenario.validation.replicates = replicates;
  return scenario;
}

int fewest_replicates(const Scenario& scenario) {
  return std::min(scenario.validation.replicates, std::max(kFewestReplicates, scenario.validation.enough_valid));
}

struct Limits {
  std::int64_t per_round, total;
};

Limits limits_of(const BudgetSettings& budget) {
  return {budget.specimens_per_round > 0 ? budget.specimens_per_round : kNoLimit,
          budget.total > 0 ? budget.total : kNoLimit};
}

bool fits(const Scenario& scenario, const Limits& limits) {
  const bool every_round =
      scenario.rounds < 1 ||
      std::max(specimens_of(scenario, 1), scenario.rounds > 1 ? specimens_of(scenario, 2) : 0) <= limits.per_round;
  return every_round && specimens_of_all(scenario, kNoLimit) <= limits.total;
}

/// The largest number of specimens per round that keeps within both limits; the smallest possible where none does.
std::int64_t levelled(const Scenario& scenario, const Limits& limits) {
  std::int64_t within = 0, beyond = std::min(limits.per_round, specimens_of(scenario, 1)) + 1;
  while (beyond - within > 1) {
    const std::int64_t middle = within + (beyond - within) / 2;
    (specimens_of_all(scenario, middle) <= limits.total ? within : beyond) = middle;
  }
  return within;
}

void add_share(std::vector<std::string>& words, int now, int full, const char* what) {
  if (now < full) words.push_back(fmt::format("{} of {} {}", now, full, what));
}

std::string listed(const std::vector<std::string>& words) {
  const auto last = words.end() - 1;
  return words.size() == 1 ? *last : fmt::format("{} and {}", fmt::join(words.begin(), last, ", "), *last);
}

}  // namespace

Scenario within_budget(const Scenario& scenario, int round) {
  const Limits limits = limits_of(scenario.budget);
  for (int replicates = scenario.validation.replicates; replicates >= fewest_replicates(scenario); --replicates) {
    Scenario fewer = with_replicates(scenario, replicates);
    if (fits(fewer, limits)) return fewer;
  }
  const Scenario least = with_replicates(scenario, fewest_replicates(scenario));
  return reduced(least, round, levelled(least, limits));
}

std::string budget_in_words(const Scenario& scenario, int round) {
  const Scenario allowed = within_budget(scenario, round);
  std::vector<std::string> words;
  add_share(words, allowed.validation.replicates, scenario.validation.replicates, "replicates");
  add_share(words, allowed.proposal.designs, scenario.proposal.designs, "designs");
  if (is_first(round)) {
    add_share(words, allowed.validation.random_patterns, scenario.validation.random_patterns, "random patterns");
    add_share(words, further_mixtures(allowed), further_mixtures(scenario), "mixtures");
  }
  if (scenario.diagnosis.enabled)
    add_share(words, allowed.diagnosis.discrimination_orders, scenario.diagnosis.discrimination_orders,
              "discrimination tests");
  return words.empty() ? "" : fmt::format("the budget allows {} in round {}", listed(words), round);
}

int least_specimens(const Scenario& scenario, int round) {
  const Scenario least = with_replicates(scenario, fewest_replicates(scenario));
  return static_cast<int>(specimens_of(reduced(least, round, 0), round));
}

int least_specimens_of_all(const Scenario& scenario) {
  return static_cast<int>(specimens_of_all(with_replicates(scenario, fewest_replicates(scenario)), 0));
}

std::vector<Order> expected_orders(const Scenario& scenario, int round) {
  const Scenario allowed = within_budget(scenario, round);
  RandomStream random(scenario.seed, "patterns to come");
  std::vector<pattern::Design> proposed;
  for (const pattern::Pattern& each : pattern::stratified_patterns(allowed.proposal.designs, random))
    proposed.emplace_back(each);
  std::vector<Order> orders = proposal_orders(allowed, round, proposed);
  const auto add = [&](std::vector<Order> more) { std::ranges::move(more, std::back_inserter(orders)); };
  if (is_first(round)) add(opening_orders(allowed, random_patterns(allowed)));
  if (allowed.diagnosis.enabled) {
    std::vector<DiscriminationTest> tests;
    for (int i = 0; i < allowed.diagnosis.discrimination_orders; ++i)
      tests.push_back({.design = pattern::Mixture{0.01 * i}});
    add(discrimination_orders(allowed, round, tests));
  }
  return orders;
}

}  // namespace nacre::game
