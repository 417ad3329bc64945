#include "diagnosis/data_summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "base/csv.hpp"
#include "base/result.hpp"
#include "base/statistics.hpp"
#include "measurement/conditions.hpp"
#include "measurement/held_strain.hpp"
#include "measurement/piece.hpp"
#include "measurement/reduction.hpp"
#include "measurement/summary.hpp"

namespace nacre::diagnosis {
namespace {

using measurement::SpecimenRecord;
using tester::TestKind;

constexpr double kInterval = 0.10;  ///< chance outside a 90 % interval

/// One number that a specimen told.
struct Reading {
  const SpecimenRecord* specimen = nullptr;
  Quantity quantity = Quantity::modulus;
  double log_value = 0.0;
};

void add(std::vector<Reading>& readings, const SpecimenRecord& specimen, Quantity quantity,
         const std::optional<double>& value_pa) {
  if (value_pa && *value_pa > 0.0) readings.push_back({&specimen, quantity, std::log(*value_pa)});
}

/// Of a pulled coupon the slope of its beginning and its largest stress.
void add_coupon(std::vector<Reading>& readings, const SpecimenRecord& specimen) {
  if (specimen.curve.empty()) return;
  if (const auto beginning = measurement::linear_part(specimen.curve))
    add(readings, specimen, Quantity::modulus, beginning->slope_pa);
  add(readings, specimen, Quantity::strength, *std::ranges::max_element(specimen.curve.stress_pa));
}

std::vector<Reading> readings_of(const std::vector<SpecimenRecord>& specimens) {
  std::vector<Reading> readings;
  for (const SpecimenRecord& specimen : specimens) {
    if (!specimen.valid) continue;
    if (specimen.test == TestKind::modulus)
      add(readings, specimen, Quantity::modulus, measurement::modulus_of(specimen));
    if (specimen.test == TestKind::toughness)
      add(readings, specimen, Quantity::toughness, measurement::toughness_of(specimen));
    if (specimen.test == TestKind::tensile) add_coupon(readings, specimen);
  }
  return readings;
}

/// Means of the readings of one piece.
std::vector<double> means_of_pieces(const std::vector<Reading>& readings) {
  std::map<std::string, std::vector<double>> of_piece;
  for (const Reading& reading : readings)
    of_piece[measurement::piece_of(*reading.specimen)].push_back(reading.log_value);
  std::vector<double> means;
  for (const auto& [piece, values] : of_piece) means.push_back(mean(values));
  return means;
}

MeasuredMean mean_of(const std::vector<Reading>& readings) {
  const SpecimenRecord& first = *readings.front().specimen;
  const std::vector<double> values = means_of_pieces(readings);
  const int count = static_cast<int>(values.size());
  const double middle = mean(values), sd = standard_deviation(values);
  const double half = count > 1 ? student_quantile(kInterval, count - 1) * sd / std::sqrt(count) : 0.0;
  return {.design = first.design.name(),
          .test = first.test,
          .conditions = first.conditions,
          .surroundings = measurement::surroundings_of(first),
          .quantity = readings.front().quantity,
          .pieces = count,
          .mean_pa = std::exp(middle),
          .low_pa = std::exp(middle - half),
          .high_pa = std::exp(middle + half),
          .scatter = sd};
}

std::vector<MeasuredMean> means_of(const std::vector<Reading>& readings) {
  using Key = std::tuple<std::string, TestKind, Quantity, double, double, double, std::string>;
  std::map<Key, std::vector<Reading>> groups;
  for (const Reading& reading : readings) {
    const SpecimenRecord& s = *reading.specimen;
    groups[{s.design.name(), s.test, reading.quantity, s.conditions.orientation_deg, s.conditions.strain_rate_per_s,
            s.conditions.thickness_mm, measurement::nominal_surroundings(measurement::surroundings_of(s))}]
        .push_back(reading);
  }
  std::vector<MeasuredMean> means;
  for (const auto& [key, group] : groups) means.push_back(mean_of(group));
  std::ranges::stable_sort(means, {}, [](const MeasuredMean& m) {
    const tester::TestConditions& c = m.conditions;
    return std::tuple(m.design, m.test, m.quantity, c.orientation_deg, c.strain_rate_per_s, c.thickness_mm,
                      m.surroundings.temperature_c, m.surroundings.humidity_pct, m.surroundings.age_days);
  });
  return means;
}

/// The value of a condition of every specimen that has it, as it was written.
using ConditionOf = std::map<const SpecimenRecord*, std::string>;

std::map<std::string, ConditionOf> conditions_of(const std::vector<SpecimenRecord>& specimens) {
  std::map<std::string, ConditionOf> conditions;
  for (const SpecimenRecord& s : specimens) {
    conditions["strain_rate_per_s"][&s] = fmt::format("{:g}", s.conditions.strain_rate_per_s);
    conditions["thickness_mm"][&s] = fmt::format("{:g}", s.conditions.thickness_mm);
    conditions["orientation_deg"][&s] = fmt::format("{:g}", s.conditions.orientation_deg);
    if (!s.batch.empty()) conditions["batch"][&s] = s.batch;
    if (s.print_order > 0) conditions["print_order"][&s] = fmt::format("{}", s.print_order);
    for (const auto& [column, text] : s.other_columns)
      if (column != measurement::kSampleColumn && column != measurement::kHoldColumn && !trimmed(text).empty())
        conditions[column][&s] = trimmed(text);
  }
  std::erase_if(conditions, [](const auto& each) {
    std::set<std::string> values;
    for (const auto& [specimen, value] : each.second) values.insert(value);
    return values.size() < 2;
  });
  return conditions;
}

/// One comparison along a condition: an abscissa for each reading that is included.
struct Comparison {
  std::string from, to;
  double span = 1.0;       ///< of the abscissa between them
  bool logarithm = false;  ///< the abscissa is a logarithm
  std::map<const SpecimenRecord*, double> x;
};

/// Against a number.
std::optional<Comparison> along_numbers(const ConditionOf& values) {
  std::map<const SpecimenRecord*, double> numbers;
  for (const auto& [specimen, text] : values) {
    const Result<double> number = number_from_text(text);
    if (!number) return std::nullopt;
    numbers[specimen] = *number;
  }
  const auto [least, most] = std::ranges::minmax_element(numbers, {}, [](const auto& each) { return each.second; });
  const double low = least->second, high = most->second;
  if (!(high > low)) return std::nullopt;
  constexpr double kDecade = 10.0;
  Comparison comparison{.from = fmt::format("{:g}", low),
                        .to = fmt::format("{:g}", high),
                        .span = high - low,
                        .logarithm = low > 0.0 && high >= kDecade * low,
                        .x = numbers};
  if (!comparison.logarithm) return comparison;
  comparison.span = std::log(high / low);
  for (auto& [specimen, x] : comparison.x) x = std::log(x);
  return comparison;
}

/// Each word against the first; columns of names without repetition are none.
std::vector<Comparison> along_words(const ConditionOf& values) {
  constexpr std::size_t kMostWords = 6;
  std::map<std::string, std::vector<const SpecimenRecord*>> of_word;
  for (const auto& [specimen, word] : values) of_word[word].push_back(specimen);
  std::vector<Comparison> comparisons;
  if (of_word.size() < 2 || of_word.size() > kMostWords || 2 * of_word.size() > values.size()) return comparisons;
  for (auto word = std::next(of_word.begin()); word != of_word.end(); ++word) {
    Comparison comparison{.from = of_word.begin()->first, .to = word->first, .x = {}};
    for (const SpecimenRecord* s : of_word.begin()->second) comparison.x[s] = 0.0;
    for (const SpecimenRecord* s : word->second) comparison.x[s] = 1.0;
    comparisons.push_back(std::move(comparison));
  }
  return comparisons;
}

/// A point of a regression: the mean over the tests of one piece at one abscissa.
struct Point {
  std::string design, piece;
  double x = 0.0, y = 0.0;
};

std::vector<Point> points_of(const std::vector<Reading>& readings, const Comparison& comparison) {
  std::map<std::tuple<std::string, std::string, double>, std::vector<double>> values;
  for (const Reading& reading : readings) {
    const auto x = comparison.x.find(reading.specimen);
    if (x == comparison.x.end()) continue;
    values[{reading.specimen->design.name(), measurement::piece_of(*reading.specimen), x->second}].push_back(
        reading.log_value);
  }
  std::vector<Point> points;
  for (const auto& [key, logs] : values)
    points.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), mean(logs)});
  return points;
}

using LevelOf = std::string Point::*;

/// Points that share a level but differ in their abscissa.
std::map<std::string, std::vector<Point>> levels_that_vary(const std::vector<Point>& points, LevelOf level) {
  std::map<std::string, std::vector<Point>> levels;
  for (const Point& point : points) levels[point.*level].push_back(point);
  std::erase_if(levels, [](const auto& each) {
    return std::ranges::all_of(each.second, [&](const Point& p) { return p.x == each.second.front().x; });
  });
  return levels;
}

struct Slope {
  double value = 0.0, error = 0.0;
  int freedom = 0;  ///< 0: the error is assumed
  int pieces = 0;
};

/// Slope within levels.
std::optional<Slope> slope_within(const std::map<std::string, std::vector<Point>>& levels, double assumed_sd) {
  double xx = 0.0, xy = 0.0, yy = 0.0;
  int points = 0;
  std::set<std::string> pieces;
  for (const auto& [name, level] : levels) {
    double x = 0.0, y = 0.0;
    for (const Point& p : level)
      x += p.x / static_cast<double>(level.size()), y += p.y / static_cast<double>(level.size());
    for (const Point& p : level) {
      xx += (p.x - x) * (p.x - x), xy += (p.x - x) * (p.y - y), yy += (p.y - y) * (p.y - y);
      pieces.insert(p.piece);
    }
    points += static_cast<int>(level.size());
  }
  if (!(xx > 0.0)) return std::nullopt;
  const int freedom = points - static_cast<int>(levels.size()) - 1;
  const double rest = std::max(0.0, yy - xy * xy / xx);
  const double sd = freedom > 0 ? std::sqrt(rest / freedom) : assumed_sd;
  return Slope{xy / xx, std::max(sd, 1e-6) / std::sqrt(xx), std::max(freedom, 0), static_cast<int>(pieces.size())};
}

std::optional<ConditionTrend> trend_of(const std::vector<Reading>& readings, const Comparison& comparison,
                                       const NoiseRules& rules) {
  const std::vector<Point> points = points_of(readings, comparison);
  auto levels = levels_that_vary(points, &Point::piece);
  std::size_t within_pieces = 0;
  for (const auto& [piece, level] : levels) within_pieces += level.size();
  if (within_pieces < points.size()) levels = levels_that_vary(points, &Point::design);
  const std::optional<Slope> slope = slope_within(levels, rules.assumed_sd);
  if (!slope) return std::nullopt;
  constexpr int kKnown = 1000;  // degrees of freedom of a scatter that is assumed
  const int freedom = slope->freedom > 0 ? slope->freedom : kKnown;
  const double half = student_quantile(kInterval, freedom) * slope->error;
  const auto ratio = [&](double value) { return std::exp(value * comparison.span); };
  return ConditionTrend{.of = {},
                        .quantity = readings.front().quantity,
                        .condition = {},
                        .from = comparison.from,
                        .to = comparison.to,
                        .pieces = slope->pieces,
                        .ratio = ratio(slope->value),
                        .low = ratio(slope->value - half),
                        .high = ratio(slope->value + half),
                        .chance = student_beyond(slope->value / slope->error, freedom),
                        .exponent = slope->value,
                        .exponent_low = slope->value - half,
                        .exponent_high = slope->value + half};
}

/// Readings that are compared with each other: of one homogeneous material, or of layouts, by one quantity.
std::map<std::pair<std::string, Quantity>, std::vector<Reading>> comparable(const std::vector<Reading>& readings) {
  std::map<std::pair<std::string, Quantity>, std::vector<Reading>> groups;
  for (const Reading& reading : readings) {
    const pattern::Design& design = reading.specimen->design;
    groups[{design.layout() ? "layouts" : design.name(), reading.quantity}].push_back(reading);
  }
  return groups;
}

std::vector<ConditionTrend> trends_of(const std::vector<SpecimenRecord>& specimens,
                                      const std::vector<Reading>& readings, const NoiseRules& rules) {
  const auto groups = comparable(readings);
  std::vector<ConditionTrend> trends;
  for (const auto& [condition, values] : conditions_of(specimens)) {
    for (const auto& [key, group] : groups) {
      ConditionOf own;
      for (const Reading& reading : group)
        if (const auto value = values.find(reading.specimen); value != values.end()) own.insert(*value);
      if (own.size() < 2) continue;
      std::vector<Comparison> comparisons;
      if (auto numbers = condition == "batch" ? std::nullopt : along_numbers(own))
        comparisons.push_back(*std::move(numbers));
      else
        comparisons = along_words(own);
      for (const Comparison& comparison : comparisons) {
        std::optional<ConditionTrend> trend = trend_of(group, comparison, rules);
        if (!trend) continue;
        trend->of = key.first;
        trend->condition = condition;
        if (condition != "strain_rate_per_s" || !comparison.logarithm)
          trend->exponent = trend->exponent_low = trend->exponent_high = 0.0;
        trends.push_back(*std::move(trend));
      }
    }
  }
  for (ConditionTrend& trend : trends) trend.chance = std::min(1.0, trend.chance * static_cast<double>(trends.size()));
  std::ranges::stable_sort(trends, {}, &ConditionTrend::chance);
  return trends;
}

}  // namespace

std::string_view to_string(Quantity quantity) {
  switch (quantity) {
    case Quantity::modulus:
      return "modulus";
    case Quantity::toughness:
      return "toughness";
    case Quantity::strength:
      break;
  }
  return "strength";
}

DataSummary summary_of_data(const std::vector<SpecimenRecord>& specimens, const NoiseRules& rules) {
  const std::vector<SpecimenRecord> nominal = measurement::at_nominal_conditions(specimens);
  const std::vector<Reading> readings = readings_of(nominal);
  return {means_of(readings), trends_of(nominal, readings, rules)};
}

const ConditionTrend* trend_along_a_further_column(const DataSummary& data, double chance) {
  static const std::set<std::string_view> kKnown = {
      "strain_rate_per_s", "thickness_mm", "orientation_deg", "batch",  "print_order",
      "temperature_c",     "humidity_pct", "age_days",        "machine"};
  const auto found = std::ranges::find_if(data.trends, [&](const ConditionTrend& trend) {
    return trend.chance < chance && !kKnown.contains(trend.condition);
  });
  return found == data.trends.end() ? nullptr : &*found;
}

}  // namespace nacre::diagnosis
