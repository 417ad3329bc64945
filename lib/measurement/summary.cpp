#include "measurement/summary.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <tuple>

#include "base/statistics.hpp"
#include "measurement/observe.hpp"

namespace nacre::measurement {
namespace {

using ReplicateKey = std::tuple<std::string, double, double, double>;

ReplicateKey group_of(const SpecimenRecord& specimen) {
  const tester::TestConditions& conditions = specimen.conditions;
  return {specimen.design.name(), conditions.orientation_deg, conditions.strain_rate_per_s, conditions.thickness_mm};
}

double mean_of(std::span<const double> values) { return values.empty() ? 0.0 : mean(values); }

/// The representative curve of the thesis (2.2.2): that of the specimen nearest to the mean toughness.
tester::Curve representative(std::span<const SpecimenRecord* const> specimens, double mean_toughness_pa) {
  const SpecimenRecord* nearest = nullptr;
  double smallest = 0.0;
  for (const SpecimenRecord* specimen : specimens) {
    if (specimen->test != tester::TestKind::toughness || specimen->curve.empty()) continue;
    const double distance = std::abs(toughness_of(*specimen).value_or(0.0) - mean_toughness_pa);
    if (nearest == nullptr || distance < smallest) {
      nearest = specimen;
      smallest = distance;
    }
  }
  return nearest == nullptr ? tester::Curve{} : nearest->curve;
}

using BatchSteps = std::map<const SpecimenRecord*, double>;

Replicates summarise_group(std::span<const SpecimenRecord* const> specimens, const BatchSteps& batch_steps) {
  Replicates group;
  group.design = specimens.front()->design;
  group.conditions = specimens.front()->conditions;
  std::set<std::string> batches;
  std::vector<double> moduli, toughnesses, modulus_steps, toughness_steps;
  for (const SpecimenRecord* specimen : specimens) {
    group.specimens.push_back(specimen->specimen);
    if (!specimen->batch.empty()) batches.insert(specimen->batch);
    const bool is_modulus = specimen->test == tester::TestKind::modulus;
    const std::optional<double> value = is_modulus ? modulus_of(*specimen) : toughness_of(*specimen);
    if (!value) continue;
    (is_modulus ? moduli : toughnesses).push_back(*value);
    (is_modulus ? modulus_steps : toughness_steps).push_back(batch_steps.at(specimen));
  }
  for (const std::string& batch : batches) group.batch_list += (group.batch_list.empty() ? "" : ",") + batch;
  group.modulus_count = moduli.size();
  group.modulus_pa = mean_of(moduli);
  group.modulus_sd_pa = standard_deviation(moduli);
  group.toughness_count = toughnesses.size();
  group.toughness_pa = mean_of(toughnesses);
  group.toughness_sd_pa = standard_deviation(toughnesses);
  group.modulus_batch_step = mean_of(modulus_steps);
  group.toughness_batch_step = mean_of(toughness_steps);
  group.representative_curve = representative(specimens, group.toughness_pa);
  return group;
}

// The interval of ISO 527, and the largest distance between the first points of a coarse curve: beyond it, a chord
// depends more on yielding than on the modulus.
constexpr double kFirstStrain = 0.0005, kLastStrain = 0.0025, kLongestChord = 0.05;

/// Slope between stresses interpolated at the two ends of the interval, for curves with few points in it.
std::optional<double> slope_of_chord(const tester::Curve& curve) {
  tester::Curve beginning;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (i > 0 && curve.strain[i] <= curve.strain[i - 1]) return std::nullopt;
    beginning.strain.push_back(curve.strain[i]);
    beginning.stress_pa.push_back(curve.stress_pa[i]);
    if (curve.strain[i] >= kLastStrain) break;
  }
  const bool covers = !beginning.empty() && beginning.strain.front() <= kFirstStrain &&
                      beginning.strain.back() >= kLastStrain && beginning.strain.back() <= kLongestChord;
  if (!covers) return std::nullopt;
  const double rise_pa = tester::stress_at(beginning, kLastStrain) - tester::stress_at(beginning, kFirstStrain);
  return rise_pa / (kLastStrain - kFirstStrain);
}

/// Number of points before the strain leaves the interval or falls for good: later points in it are of unloading or of
/// a broken specimen.
std::size_t points_of_loading(const std::vector<double>& strain) {
  const auto beyond = std::find_if(strain.begin(), strain.end(), [](double e) { return e > kLastStrain; });
  if (beyond != strain.end()) return static_cast<std::size_t>(beyond - strain.begin());
  const auto largest = std::max_element(strain.begin(), strain.end());
  return static_cast<std::size_t>(largest - strain.begin()) + (strain.empty() ? 0 : 1);
}

/// Least-squares slope over the interval's points where there are three, else that of the chord.
std::optional<double> initial_slope(const tester::Curve& curve) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  const std::size_t loading = points_of_loading(curve.strain);
  for (std::size_t i = 0; i < loading; ++i) {
    const double strain = curve.strain[i], stress = curve.stress_pa[i];
    if (strain < kFirstStrain || strain > kLastStrain) continue;
    n += 1.0;
    x += strain;
    y += stress;
    xx += strain * strain;
    xy += strain * stress;
  }
  if (n < 3.0) return slope_of_chord(curve);
  const double spread = n * xx - x * x;
  return spread > 0.0 ? std::optional((n * xy - x * y) / spread) : std::nullopt;
}

}  // namespace

std::optional<double> modulus_of(const SpecimenRecord& specimen) {
  if (specimen.modulus_pa) return specimen.modulus_pa;
  if (specimen.test != tester::TestKind::modulus) return std::nullopt;
  const std::optional<double> slope = initial_slope(specimen.curve);
  return slope && *slope > 0.0 ? slope : std::nullopt;
}

std::optional<double> toughness_of(const SpecimenRecord& specimen) {
  if (specimen.toughness_pa) return specimen.toughness_pa;
  if (specimen.curve.empty()) return std::nullopt;
  return tester::area_under(specimen.curve);
}

std::vector<Replicates> summarise(const std::vector<SpecimenRecord>& specimens) {
  std::map<ReplicateKey, std::vector<const SpecimenRecord*>> groups;
  BatchSteps batch_steps;
  const std::vector<PrintContext> contexts = print_contexts(specimens);
  for (std::size_t i = 0; i < specimens.size(); ++i) batch_steps.emplace(&specimens[i], contexts[i].batch_step);
  for (const SpecimenRecord& specimen : specimens) {
    if (specimen.valid && specimen.test != tester::TestKind::tensile) groups[group_of(specimen)].push_back(&specimen);
  }
  std::vector<Replicates> replicates;
  for (auto& entry : groups) {
    auto& members = entry.second;
    std::sort(members.begin(), members.end(), [](const auto* a, const auto* b) { return a->specimen < b->specimen; });
    const auto repeat = [](const auto* a, const auto* b) { return *a == *b; };
    members.erase(std::unique(members.begin(), members.end(), repeat), members.end());
    replicates.push_back(summarise_group(members, batch_steps));
  }
  return replicates;
}

}  // namespace nacre::measurement
