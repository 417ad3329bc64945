#include "game/round_growth.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "base/random.hpp"
#include "base/square.hpp"
#include "base/statistics.hpp"

namespace nacre::game {
namespace {

using Points = std::vector<optimize::Performance>;

constexpr int kDraws = 4000;
constexpr double kNormalBeyondTenPercent = 1.6448536269514722;

double growth_gpa_mpa(const Points& before, const Points& added) {
  Points all = before;
  all.insert(all.end(), added.begin(), added.end());
  return optimize::hypervolume_staircase_gpa_mpa(all) - optimize::hypervolume_staircase_gpa_mpa(before);
}

optimize::Performance drawn(const MeasuredDesign& design, RandomStream& random) {
  const double modulus_pa = design.mean.modulus_pa + design.modulus_error_pa * random.normal();
  const double toughness_pa = design.mean.toughness_pa + design.toughness_error_pa * random.normal();
  return {std::max(0.0, modulus_pa), std::max(0.0, toughness_pa)};
}

/// Of values that `draw` returns.
Growth growth_of_draws(const std::function<double()>& draw) {
  const double first = draw();
  std::vector<double> beyond = {0.0};  // the first one: without scatter the error is exactly 0, not rounding
  while (beyond.size() < kDraws) beyond.push_back(draw() - first);
  return {.mean_gpa_mpa = first + mean(beyond),
          .error_gpa_mpa = standard_deviation(beyond),
          .low_gpa_mpa = first + quantile(beyond, 0.05),
          .high_gpa_mpa = first + quantile(beyond, 0.95)};
}

}  // namespace

Growth growth_in_round(std::span<const MeasuredDesign> measured, int round, std::uint64_t seed) {
  RandomStream random(seed, "growth in a round");
  const auto between = [&](const auto& value_of) {
    Points before, added;
    for (const MeasuredDesign& each : measured)
      if (each.round <= round) (each.round < round ? before : added).push_back(value_of(each));
    return growth_gpa_mpa(before, added);
  };
  Growth growth = growth_of_draws([&] { return between([&](const auto& each) { return drawn(each, random); }); });
  growth.mean_gpa_mpa = between([](const MeasuredDesign& each) { return each.mean; });
  return growth;
}

PredictionScatter prediction_scatter(std::span<const int> rounds, std::span<const double> log_errors) {
  std::map<int, std::vector<double>> by_round;
  for (std::size_t i = 0; i < log_errors.size(); ++i) by_round[rounds[i]].push_back(log_errors[i]);
  const auto count = static_cast<double>(log_errors.size());
  double all = 0.0, within = 0.0;
  for (const auto& [round, errors] : by_round) {
    const double centre = mean(errors);
    for (const double error : errors) {
      all += square(error) / count;
      within += square(error - centre);
    }
  }
  const int freedom = static_cast<int>(log_errors.size() - by_round.size());
  const double of_design = freedom > 0 ? within / freedom : all;
  const double widening = student_quantile(0.1, std::max(1, freedom)) / kNormalBeyondTenPercent;
  return {.of_round = widening * std::sqrt(std::max(0.0, all - of_design)),
          .of_design = widening * std::sqrt(of_design)};
}

Growth expected_growth(std::span<const MeasuredDesign> measured, std::span<const optimize::Performance> predicted,
                       const PredictionScatter& modulus, const PredictionScatter& toughness, std::uint64_t seed) {
  RandomStream random(seed, "growth in the next round");
  return growth_of_draws([&] {
    Points before, added;
    for (const MeasuredDesign& each : measured) before.push_back(drawn(each, random));
    const double modulus_bias = modulus.of_round * random.normal();
    const double toughness_bias = toughness.of_round * random.normal();
    for (const optimize::Performance& each : predicted) {
      const double modulus_error = modulus_bias + modulus.of_design * random.normal();
      const double toughness_error = toughness_bias + toughness.of_design * random.normal();
      added.push_back({each.modulus_pa * std::exp(modulus_error), each.toughness_pa * std::exp(toughness_error)});
    }
    return growth_gpa_mpa(before, added);
  });
}

}  // namespace nacre::game
