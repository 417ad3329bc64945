// What the history of specimens (batch, operator, machine, date, print order) does to their values.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "base/statistics.hpp"
#include "measurement/conditions.hpp"
#include "measurement/consistency.hpp"

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

/// Residuals of one test against groups of the same design and conditions; groups of one specimen say nothing.
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

/// Levels of a factor, each against the rest.
void add_levels(const std::vector<Residual>& residuals, const std::string& factor, tester::TestKind test,
                std::vector<HistoryEffect>& effects) {
  std::map<std::size_t, std::set<std::string>> levels_of_group;
  for (const Residual& each : residuals) levels_of_group[each.group].insert(level_of(*each.specimen, factor));
  std::map<std::string, std::vector<double>> levels;
  for (const Residual& each : residuals) {
    const std::string level = level_of(*each.specimen, factor);
    if (!level.empty() && levels_of_group[each.group].size() > 1) levels[level].push_back(each.value);
  }
  if (levels.size() < 2) return;
  std::vector<double> within;
  for (const auto& [level, values] : levels) {
    for (const double value : values) within.push_back(value - mean(values));
  }
  const int lost = static_cast<int>(levels.size());
  if (static_cast<int>(within.size()) <= lost) return;
  const double scatter = root_mean_square(within, lost);
  for (const auto& [level, values] : levels) {
    const double difference = mean(values);
    effects.push_back({factor, level, test, std::expm1(difference),
                       std::exp(difference) * scatter / std::sqrt(static_cast<double>(values.size())),
                       static_cast<int>(values.size())});
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
  effects.push_back({"print_order", "per 10 specimens", test, std::expm1(kPer * slope), kPer * error,
                     static_cast<int>(order.size())});
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
  return effects;
}

}  // namespace nacre::measurement
