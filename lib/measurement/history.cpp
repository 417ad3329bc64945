#include "measurement/history.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "base/statistics.hpp"
#include "measurement/conditions.hpp"
#include "measurement/summary.hpp"

namespace nacre::measurement {
namespace {

/// A specimen's log value over the mean of its design.
struct Residual {
  const SpecimenRecord* specimen;
  double value;
  std::size_t group;
};

std::string level_of(const SpecimenRecord& specimen, const std::string& factor) {
  if (factor == "batch") return specimen.batch;
  const auto cell = specimen.other_columns.find(factor);
  return cell == specimen.other_columns.end() ? "" : cell->second;
}

/// Residuals of one test against groups of the same design and conditions; groups of one specimen are left out.
std::vector<Residual> residuals_of(const std::vector<SpecimenRecord>& specimens, tester::TestKind test) {
  std::map<std::tuple<std::string, double, double, double>, std::vector<Residual>> groups;
  for (const SpecimenRecord& specimen : specimens) {
    if (!specimen.valid || specimen.test != test) continue;
    const auto value = test == tester::TestKind::modulus ? modulus_of(specimen) : toughness_of(specimen);
    if (!value || *value <= 0.0) continue;
    const tester::TestConditions& c = specimen.conditions;
    groups[{specimen.design.name(), c.orientation_deg, c.strain_rate_per_s, c.thickness_mm}].push_back(
        {&specimen, std::log(*value), 0});
  }
  std::vector<Residual> residuals;
  std::size_t number = 0;
  for (auto& [key, group] : groups) {
    ++number;
    if (group.size() < 2) continue;
    double sum = 0.0;
    for (const Residual& each : group) sum += each.value;
    for (const Residual& each : group)
      residuals.push_back({each.specimen, each.value - sum / static_cast<double>(group.size()), number});
  }
  return residuals;
}

/// An effect on the logarithm, its error with `left` degrees of freedom; `chance` is that of this one alone.
HistoryEffect effect_of(double difference, double error, int left) {
  HistoryEffect effect;
  effect.relative = std::expm1(difference);
  effect.standard_error = std::exp(difference) * error;
  effect.chance = error > 0.0 ? student_beyond(difference / error, left) : difference != 0.0 ? 0.0 : 1.0;
  return effect;
}

/// Levels of a factor, each against the mean of its designs.
void add_levels(const std::vector<Residual>& residuals, const std::string& factor, tester::TestKind test,
                std::vector<HistoryEffect>& effects) {
  std::map<std::size_t, std::map<std::string, double>> counts;  // of the specimens of a level, by group
  for (const Residual& each : residuals) ++counts[each.group][level_of(*each.specimen, factor)];
  std::erase_if(counts, [](const auto& group) { return group.second.size() < 2; });
  std::map<std::string, std::vector<double>> levels;
  std::map<std::string, double> own;  // variance of a level's mean relative to its groups' means, times its count
  for (const Residual& each : residuals) {
    const std::string level = level_of(*each.specimen, factor);
    const auto group = counts.find(each.group);
    if (level.empty() || group == counts.end()) continue;
    double of_group = 0.0;
    for (const auto& [name, count] : group->second) of_group += count;
    levels[level].push_back(each.value);
    own[level] += 1.0 - group->second[level] / of_group;
  }
  if (levels.size() < 2) return;
  std::vector<double> within;
  for (const auto& [level, values] : levels) {
    for (const double value : values) within.push_back(value - mean(values));
  }
  const int lost =
      static_cast<int>(counts.size() + levels.size()) - 1;  // the mean of the levels is fixed by the groups
  const int left = static_cast<int>(within.size()) - lost;
  if (left <= 0) return;
  const double scatter = root_mean_square(within, lost);
  for (const auto& [level, values] : levels) {
    const double count = static_cast<double>(values.size());
    HistoryEffect effect = effect_of(mean(values), scatter * std::sqrt(own[level]) / count, left);
    effect.factor = factor;
    effect.level = level;
    effect.test = test;
    effect.specimens = values.size();
    effects.push_back(effect);
  }
}

/// The trend with print order, by least squares inside groups of the same design: designs printed one after another
/// differ for reasons of their own.
void add_trend(const std::vector<Residual>& residuals, tester::TestKind test, std::vector<HistoryEffect>& effects) {
  struct Group {
    std::vector<double> order, value;
  };
  std::map<std::size_t, Group> groups;
  for (const Residual& each : residuals) {
    if (each.specimen->print_order <= 0) continue;
    groups[each.group].order.push_back(each.specimen->print_order);
    groups[each.group].value.push_back(each.value);
  }
  std::vector<double> order, value;
  for (const auto& [number, group] : groups) {
    for (const double x : group.order) order.push_back(x - mean(group.order));
    for (const double y : group.value) value.push_back(y - mean(group.value));
  }
  const int lost = static_cast<int>(groups.size()) + 1;
  constexpr std::size_t kFewest = 4;
  if (order.size() < kFewest || static_cast<int>(order.size()) <= lost) return;
  const double squares = std::inner_product(order.begin(), order.end(), order.begin(), 0.0);
  if (squares <= 0.0) return;
  const double slope = std::inner_product(order.begin(), order.end(), value.begin(), 0.0) / squares;
  std::vector<double> left;
  for (std::size_t i = 0; i < order.size(); ++i) left.push_back(value[i] - slope * order[i]);
  const double error = root_mean_square(left, lost) / std::sqrt(squares);
  constexpr double kPer = 10.0;
  HistoryEffect effect = effect_of(kPer * slope, kPer * error, static_cast<int>(order.size()) - lost);
  effect.factor = "print_order";
  effect.level = "per 10 specimens";
  effect.test = test;
  effect.specimens = order.size();
  effects.push_back(effect);
}

}  // namespace

std::vector<HistoryEffect> history_effects(const std::vector<SpecimenRecord>& specimens) {
  const std::vector<SpecimenRecord> nominal = at_nominal_conditions(specimens);
  std::vector<HistoryEffect> effects;
  for (const auto test : {tester::TestKind::modulus, tester::TestKind::toughness}) {
    const std::vector<Residual> residuals = residuals_of(nominal, test);
    for (const char* factor : {"batch", "operator", "machine", "date"}) add_levels(residuals, factor, test, effects);
    add_trend(residuals, test, effects);
  }
  for (HistoryEffect& effect : effects)
    effect.chance = std::min(1.0, effect.chance * static_cast<double>(effects.size()));
  return effects;
}

}  // namespace nacre::measurement
