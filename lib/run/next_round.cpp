#include "run/next_round.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "run/measured_patterns.hpp"

namespace nacre::run {
namespace {

constexpr std::uint64_t kSeed = 1;  // the same figures whenever they are asked for
constexpr int kFirstThatKnowsPatterns = 2, kRoundsSaid = 2;

using Patterns = std::map<std::string, MeasuredPattern>;  // by name

Patterns by_name(const RunRecord& run, int round) {
  Patterns patterns;
  for (const MeasuredPattern& each : measured_patterns(run, round)) patterns.emplace(each.pattern.key(), each);
  return patterns;
}

std::vector<game::MeasuredDesign> designs_of(const Patterns& patterns) {
  std::vector<game::MeasuredDesign> designs;
  for (const auto& [name, each] : patterns)
    designs.push_back({.round = each.round,
                       .mean = each.mean,
                       .modulus_error_pa = each.modulus_sd_pa / std::sqrt(each.modulus_count),
                       .toughness_error_pa = each.toughness_sd_pa / std::sqrt(each.toughness_count)});
  return designs;
}

/// ln(measured / predicted) of designs that were proposed before they were measured.
struct LogErrors {
  std::vector<int> rounds;
  std::vector<double> modulus, toughness;
};

LogErrors errors_until(const RunRecord& run, const Patterns& measured, int last) {
  LogErrors errors;
  for (const auto& [number, round] : run.rounds) {
    if (number + 1 < kFirstThatKnowsPatterns || number + 1 > last) continue;
    for (const wire::ProposedDesign& design : round.proposals) {
      const auto found = measured.find(design.design.name());
      const bool is_comparable = found != measured.end() && found->second.round == number + 1 &&
                                 design.modulus_pa > 0.0 && design.toughness_pa > 0.0;
      if (!is_comparable) continue;
      errors.rounds.push_back(number + 1);
      errors.modulus.push_back(std::log(found->second.mean.modulus_pa / design.modulus_pa));
      errors.toughness.push_back(std::log(found->second.mean.toughness_pa / design.toughness_pa));
    }
  }
  return errors;
}

std::vector<optimize::Performance> to_be_measured(const RoundRecord& round, const Patterns& measured) {
  std::vector<optimize::Performance> designs;
  for (const wire::ProposedDesign& each : round.proposals)
    if (!measured.contains(each.design.name())) designs.push_back(predicted(each));
  return designs;
}

game::PredictionScatter scatter_of_fit(double mean_relative_error) {
  return {.of_round = 0.0, .of_design = mean_relative_error * std::sqrt(std::numbers::pi / 2.0)};
}

std::string with_error(const game::Growth& growth) {
  const double error = growth.error_gpa_mpa;
  const int decimals = error > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 6) : 4;
  return fmt::format("{:.{}f} +- {:.{}f}", growth.mean_gpa_mpa, decimals, error, decimals);
}

std::string brought_in_words(const NextRound& next) {
  std::string words;
  for (const NextRound::Brought& each : next.brought)
    words += words.empty() ? fmt::format("round {} brought {} GPa MPa of measured hypervolume", each.round,
                                         with_error(each.growth))
                           : fmt::format(", round {} {}", each.round, with_error(each.growth));
  return words;
}

}  // namespace

NextRound next_round(const RunRecord& run) {
  const int closed = newest_closed_round(run).value_or(-1);
  NextRound next;
  next.round = std::max(1, closed + 1);
  const Patterns measured = by_name(run, closed);
  if (closed < 1 || measured.empty()) {
    next.unknown = "it cannot be told yet what a round brings: no pattern is measured";
    return next;
  }
  const std::vector<game::MeasuredDesign> designs = designs_of(measured);
  std::vector<optimize::Performance> means;
  for (const game::MeasuredDesign& each : designs) means.push_back(each.mean);
  next.hypervolume_gpa_mpa = optimize::hypervolume_staircase_gpa_mpa(means);
  for (int round = std::max(1, closed + 1 - kRoundsSaid); round <= closed; ++round)
    next.brought.push_back({round, game::growth_in_round(designs, round, kSeed)});
  const RoundRecord& newest = run.rounds.at(closed);
  const auto proposed = to_be_measured(newest, measured);
  if (proposed.empty()) {
    next.unknown = fmt::format("round {} has proposed no design that is not measured", closed);
    return next;
  }
  const LogErrors errors = errors_until(run, measured, closed);
  next.is_scatter_of_fit = errors.rounds.size() < NextRound::kFewestErrors;
  const sysid::PredictionErrors& fit = newest.summary->after;
  next.expected =
      next.is_scatter_of_fit
          ? game::expected_growth(designs, proposed, scatter_of_fit(fit.modulus_mean),
                                  scatter_of_fit(fit.toughness_mean), kSeed)
          : game::expected_growth(designs, proposed, game::prediction_scatter(errors.rounds, errors.modulus),
                                  game::prediction_scatter(errors.rounds, errors.toughness), kSeed);
  return next;
}

std::string in_words(const NextRound& next) {
  const std::string brought = brought_in_words(next);
  if (!next.expected) return brought.empty() ? next.unknown : fmt::format("{}; {}", brought, next.unknown);
  const game::Growth& growth = *next.expected;
  return fmt::format("{}; round {} is expected to bring {}, {:.2g} % of {:.3g} (90 %: {:.2g} to {:.2g}{})", brought,
                     next.round, with_error(growth), 100.0 * growth.mean_gpa_mpa / next.hypervolume_gpa_mpa,
                     next.hypervolume_gpa_mpa, growth.low_gpa_mpa, growth.high_gpa_mpa,
                     next.is_scatter_of_fit ? "; by the errors of the fit" : "");
}

}  // namespace nacre::run
