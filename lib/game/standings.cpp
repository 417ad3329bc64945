#include "game/standings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "base/random.hpp"
#include "base/statistics.hpp"
#include "game/rounds.hpp"
#include "measurement/conditions.hpp"

namespace nacre::game {
namespace {

// Specimens under the same nominal conditions are replicates of each other.
std::vector<measurement::Replicates> summarise_nominally(const std::vector<measurement::SpecimenRecord>& specimens) {
  return measurement::summarise(measurement::at_nominal_conditions(specimens));
}

bool upright(const tester::TestConditions& conditions) { return std::abs(conditions.orientation_deg) < 0.5; }

double mean_of_realisations(const std::vector<double>& values, RandomStream& random) {
  const int count = values.size();
  if (count < 2) return values.front();
  double sum = 0.0;
  for (int draw = 0; draw < count; ++draw) sum += values[random.index(count)];
  const double centre = mean(values);
  const double widening = std::sqrt(count / (count - 1.0));
  return std::max(0.0, centre + widening * (sum / count - centre));
}

}  // namespace

bool is_standard(const tester::TestConditions& conditions) { return fulfils(conditions, {}); }

std::vector<measurement::Replicates> under_standard_conditions(std::vector<measurement::Replicates> measured) {
  std::erase_if(measured, [](const measurement::Replicates& each) { return !is_standard(each.conditions); });
  return measured;
}

std::map<pattern::Pattern, MeasuredValues> measured_values(std::span<const measurement::SpecimenRecord> specimens) {
  std::map<pattern::Pattern, MeasuredValues> values;
  for (const measurement::SpecimenRecord& specimen : specimens) {
    const pattern::Layout* layout = specimen.design.layout();
    if (!specimen.valid || layout == nullptr || !is_standard(specimen.conditions)) continue;
    const auto pattern = pattern::Pattern::from_layout(*layout);
    if (!pattern) continue;
    if (specimen.test == tester::TestKind::modulus) {
      if (const auto modulus_pa = measurement::modulus_of(specimen)) values[*pattern].modulus_pa.push_back(*modulus_pa);
    } else if (specimen.test == tester::TestKind::toughness) {
      if (const auto toughness_pa = measurement::toughness_of(specimen))
        values[*pattern].toughness_pa.push_back(*toughness_pa);
    }
  }
  return values;
}

std::vector<optimize::Performance> measured_performances(const std::map<pattern::Pattern, MeasuredValues>& values) {
  std::vector<optimize::Performance> performances;
  for (const auto& [pattern, measured] : values) {
    if (measured.modulus_pa.empty() || measured.toughness_pa.empty()) continue;
    performances.push_back({mean(measured.modulus_pa), mean(measured.toughness_pa)});
  }
  return performances;
}

double hypervolume_error(const std::map<pattern::Pattern, MeasuredValues>& values, std::uint64_t seed, int resamples) {
  RandomStream random(seed, "hypervolume bootstrap");
  std::vector<double> hypervolumes;
  for (int resample = 0; resample < resamples; ++resample) {
    std::vector<optimize::Performance> drawn;
    for (const auto& [pattern, measured] : values) {
      if (measured.modulus_pa.empty() || measured.toughness_pa.empty()) continue;
      const double modulus_pa = mean_of_realisations(measured.modulus_pa, random);
      drawn.push_back({modulus_pa, mean_of_realisations(measured.toughness_pa, random)});
    }
    hypervolumes.push_back(optimize::hypervolume_staircase_gpa_mpa(drawn));
  }
  if (hypervolumes.size() < 2) return 0.0;
  // About the first draw: without scatter the error is exactly 0, not rounding.
  const double first = hypervolumes.front();
  for (double& hypervolume : hypervolumes) hypervolume -= first;
  const double centre = mean(hypervolumes);
  double squares = 0.0;
  for (double hypervolume : hypervolumes) squares += (hypervolume - centre) * (hypervolume - centre);
  return std::sqrt(squares / static_cast<double>(hypervolumes.size() - 1));
}

std::vector<optimize::Performance> benchmark_line(const std::vector<measurement::SpecimenRecord>& specimens) {
  std::map<double, optimize::Performance> by_fraction;
  for (const measurement::Replicates& each : under_standard_conditions(summarise_nominally(specimens))) {
    const pattern::Mixture* mixture = each.design.mixture();
    if (mixture == nullptr || each.modulus_count == 0 || each.toughness_count == 0) continue;
    by_fraction.try_emplace(mixture->rigid_fraction, optimize::Performance{each.modulus_pa, each.toughness_pa});
  }
  std::vector<optimize::Performance> line;
  for (const auto& [fraction, performance] : by_fraction) line.push_back(performance);
  return line;
}

std::vector<measurement::Replicates> calibration_set(const std::vector<measurement::SpecimenRecord>& specimens) {
  std::vector<measurement::Replicates> set = summarise_nominally(specimens);
  std::erase_if(set, [](const measurement::Replicates& each) {
    return each.design.layout() == nullptr || !upright(each.conditions) ||
           (each.modulus_count == 0 && each.toughness_count == 0);
  });
  return set;
}

std::vector<std::string> specimens_to_name(const std::vector<measurement::SpecimenRecord>& specimens,
                                           std::size_t most_bytes) {
  std::map<std::string, std::string> group_of;  // nominal design, test and conditions, by specimen
  for (const measurement::SpecimenRecord& each : measurement::at_nominal_conditions(specimens)) {
    if (!each.valid) continue;
    const tester::TestConditions& tested = each.conditions;
    group_of[each.specimen] = fmt::format("{} {} {} {} {}", each.design.name(), tester::to_string(each.test),
                                          tested.orientation_deg, tested.strain_rate_per_s, tested.thickness_mm);
  }
  std::map<std::string, int> count;                       // of replicates, by group
  std::vector<std::pair<int, std::string>> by_replicate;  // number, name
  for (const auto& [name, group] : group_of) by_replicate.emplace_back(count[group]++, name);
  std::ranges::sort(by_replicate);
  std::vector<std::string> names;
  constexpr std::size_t kBeyondLetters = 9;
  for (const auto& [number, name] : by_replicate) {
    if (name.size() + kBeyondLetters > most_bytes) break;
    most_bytes -= name.size() + kBeyondLetters;
    names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

std::optional<pattern::Pattern> eightfold_pattern(const pattern::Design& design) {
  return design.layout() == nullptr ? std::nullopt : pattern::Pattern::from_layout(*design.layout());
}

std::vector<measurement::Replicates> patterns_with_both(const std::vector<measurement::SpecimenRecord>& specimens) {
  std::vector<measurement::Replicates> set = under_standard_conditions(calibration_set(specimens));
  std::erase_if(set, [](const measurement::Replicates& each) {
    return !eightfold_pattern(each.design) || each.modulus_count == 0 || each.toughness_count == 0;
  });
  return set;
}

PredictedDesigns predicted_among(const std::vector<measurement::Replicates>& measured,
                                 const std::map<std::string, sysid::Prediction>& predictions) {
  PredictedDesigns predicted;
  for (const measurement::Replicates& each : under_standard_conditions(measured)) {
    const auto prediction = predictions.find(each.design.name());
    if (prediction == predictions.end()) continue;
    predicted.measured.push_back(each);
    predicted.predicted.push_back(prediction->second);
  }
  return predicted;
}

}  // namespace nacre::game
