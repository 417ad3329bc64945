#include "run/measured_patterns.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "base/statistics.hpp"
#include "game/standings.hpp"

namespace nacre::run {

std::optional<int> newest_round(const RunRecord& run) {
  return run.rounds.empty() ? std::nullopt : std::optional<int>(run.rounds.rbegin()->first);
}

std::optional<int> newest_closed_round(const RunRecord& run) {
  for (auto round = run.rounds.rbegin(); round != run.rounds.rend(); ++round) {
    if (round->second.summary) return round->first;
  }
  return std::nullopt;
}

bool is_over(const RunRecord& run) {
  const auto closed = newest_closed_round(run);
  return closed && run.rounds.at(*closed).summary->last;
}

std::vector<MeasuredPattern> measured_patterns(const RunRecord& run, int round) {
  std::vector<measurement::SpecimenRecord> known;
  std::map<std::string, int> first_round;
  for (const MeasuredSpecimen& specimen : run.specimens) {
    if (specimen.measured_in > round) continue;
    known.push_back(specimen.record);
    const auto [place, is_new] = first_round.emplace(specimen.record.design.name(), specimen.measured_in);
    if (!is_new) place->second = std::min(place->second, specimen.measured_in);
  }
  std::vector<MeasuredPattern> patterns;
  for (const auto& [pattern, values] : game::measured_values(known)) {
    if (values.modulus_pa.empty() || values.toughness_pa.empty()) continue;
    patterns.push_back({.pattern = pattern,
                        .mean = {mean(values.modulus_pa), mean(values.toughness_pa)},
                        .modulus_sd_pa = standard_deviation(values.modulus_pa),
                        .toughness_sd_pa = standard_deviation(values.toughness_pa),
                        .modulus_count = static_cast<int>(values.modulus_pa.size()),
                        .toughness_count = static_cast<int>(values.toughness_pa.size()),
                        .round = first_round.at(pattern.key())});
  }
  return patterns;
}

}  // namespace nacre::run
