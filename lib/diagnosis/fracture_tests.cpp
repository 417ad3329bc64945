#include "diagnosis/fracture_tests.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "material/extensions.hpp"
#include "sysid/calibration.hpp"
#include "sysid/objective.hpp"

namespace nacre::diagnosis {
namespace {

/// A group in the form that a calibration uses.
measurement::Replicates replicates_of(const Observation& group, double log_toughness_sd) {
  measurement::Replicates measured;
  measured.design = group.design;
  measured.conditions = group.conditions;
  measured.toughness_count = group.replicates;
  measured.toughness_pa = std::exp(value_of(group.features, Feature::log_toughness).value_or(0.0));
  measured.toughness_sd_pa = group.replicates > 1 ? measured.toughness_pa * log_toughness_sd : 0.0;
  measured.representative_curve = group.curve;
  return measured;
}

FractureRun run_of(const material::ParameterSet& parameters, const std::vector<sysid::Prediction>& of_designs,
                   const std::vector<std::size_t>& of_group) {
  FractureRun run{parameters, {}};
  for (const std::size_t design : of_group)
    run.predictions.push_back(design < of_designs.size() ? of_designs[design] : sysid::Prediction{});
  return run;
}

/// Indices of so many upright layouts, from the least rigid to the most.
std::vector<std::size_t> spread_over_rigid_fraction(const std::vector<measurement::Replicates>& measured, int most) {
  std::vector<std::size_t> upright;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const auto same = [&](std::size_t other) { return measured[other].design == measured[i].design; };
    const bool is_upright_layout = measured[i].design.layout() && measured[i].conditions.orientation_deg == 0.0;
    if (is_upright_layout && std::ranges::none_of(upright, same)) upright.push_back(i);
  }
  std::ranges::stable_sort(upright, {}, [&](std::size_t i) { return measured[i].design.rigid_fraction(); });
  const auto count = static_cast<std::size_t>(std::max(most, 2));
  if (upright.size() <= count) return upright;
  std::vector<std::size_t> spread;
  for (std::size_t k = 0; k < count; ++k) spread.push_back(upright[k * (upright.size() - 1) / (count - 1)]);
  return spread;
}

}  // namespace

material::ParameterSet simulated_side(const material::ParameterSet& set) {
  material::ParameterSet result = set;
  std::erase_if(result.extensions, [](const auto& extension) {
    const bool off = std::all_of(extension.second.begin(), extension.second.end(), [](double v) { return v == 0.0; });
    return off || material::acts_in_measurement(extension.first);
  });
  return result;
}

FeatureValues shown_features(const sysid::Prediction& prediction, const material::Extensions& extensions,
                             const CurveReading& reading, const measurement::PrintContext& context) {
  if (!prediction.toughness_pa || prediction.curve.empty()) return {};
  const sysid::Prediction shown = sysid::observed(prediction, extensions, context);
  FeatureValues features = fracture_features(shown.curve, reading);
  if (shown.toughness_pa && *shown.toughness_pa > 0.0)
    value_of(features, Feature::log_toughness) = std::log(*shown.toughness_pa);
  return features;
}

FractureGroups fracture_groups(const Observations& observations) {
  const double sd = observations.replicate_sd(Feature::log_toughness, tester::TestKind::toughness);
  FractureGroups found;
  for (std::size_t g = 0; g < observations.groups.size(); ++g) {
    if (observations.groups[g].test != tester::TestKind::toughness) continue;
    found.groups.push_back(static_cast<int>(g));
    found.measured.push_back(replicates_of(observations.groups[g], sd));
  }
  return found;
}

FractureTests::FractureTests(const Observations& observations, tester::Fidelity fidelity,
                             const std::filesystem::path& store, int threads)
    : of_set_(fracture_groups(observations)),
      simulator_(std::make_unique<sysid::LocalSimulator>(fidelity, threads, store)) {}

std::vector<FractureRun> FractureTests::runs_at(const std::vector<material::ParameterSet>& sets,
                                                std::span<const FractureRun> known,
                                                const std::function<void()>& done) const {
  std::vector<sysid::WantedEvaluation> wanted;
  std::vector<std::size_t> items(of_set_.measured.size());
  std::iota(items.begin(), items.end(), std::size_t{0});
  for (const material::ParameterSet& set : sets) {
    const material::ParameterSet simulated = simulated_side(set);
    const auto same = [&](const auto& other) {
      return other.parameters.toughness == simulated.toughness && other.parameters.extensions == simulated.extensions;
    };
    if (std::ranges::any_of(known, same) || std::ranges::any_of(wanted, same)) continue;
    // A run breaks specimens of its own, so that what is fitted through all of them averages cracks.
    const int number = known.size() + wanted.size();
    wanted.push_back({.id = fmt::format("run {}", number),
                      .parameters = simulated,
                      .toughness = true,
                      .items = items,
                      .first_specimen = tester::kFirstCalibrationSpecimen + number});
  }
  auto predictions = simulator_->simulate(of_set_.measured, wanted, done);
  std::vector<FractureRun> runs;
  for (std::size_t k = 0; k < wanted.size(); ++k) runs.push_back({wanted[k].parameters, std::move(predictions[k])});
  return runs;
}

std::vector<RefinedLayout> FractureTests::refined_layouts(const material::ParameterSet& set,
                                                          const CurveReading& reading, const EmulatorRules& rules,
                                                          const std::function<void()>& done) const {
  const std::vector<std::size_t> items = spread_over_rigid_fraction(of_set_.measured, rules.refined_layouts);
  std::vector<sysid::WantedEvaluation> wanted;
  for (const int refinement : {1, 2})
    for (int k = 0; k < rules.refined_specimens; ++k)
      wanted.push_back({.id = fmt::format("h/{} {}", refinement, k),
                        .parameters = simulated_side(set),
                        .toughness = true,
                        .items = items,
                        .first_specimen = tester::kFirstPredictionSpecimen + k,
                        .refinement = refinement});
  const auto predictions = simulator_->simulate(of_set_.measured, wanted, done);
  const auto count = static_cast<std::size_t>(rules.refined_specimens);
  std::vector<RefinedLayout> layouts;
  for (std::size_t i = 0; i < items.size(); ++i) {
    RefinedLayout layout{.design = of_set_.measured[items[i]].design, .coarse = {}, .fine = {}};
    bool broke = true;
    for (std::size_t k = 0; k < 2 * count; ++k) {
      const sysid::Prediction& one = predictions[k][i];
      broke = broke && one.toughness_pa.has_value();
      (k < count ? layout.coarse : layout.fine).push_back(shown_features(one, {}, reading));
    }
    if (broke) layouts.push_back(std::move(layout));
  }
  return layouts;
}

// Turned twins and other conditions are the same specimens to the base model: one of each design is simulated. A group
// without a toughness has none.
FractureTests::Designs FractureTests::designs() const {
  constexpr double kLeastPa = 1.0;
  Designs designs;
  for (const measurement::Replicates& each : of_set_.measured)
    if (each.toughness_pa > kLeastPa &&
        std::ranges::find(designs.measured, each.design, &measurement::Replicates::design) == designs.measured.end())
      designs.measured.push_back(each);
  for (const measurement::Replicates& each : of_set_.measured)
    designs.of_group.push_back(std::ranges::find(designs.measured, each.design, &measurement::Replicates::design) -
                               designs.measured.begin());
  return designs;
}

FractureSearch FractureTests::search(const material::ParameterSet& start, const material::ParameterRanges& ranges,
                                     int budget, std::uint64_t seed, const sysid::ProgressCallback& progress) const {
  const Designs searched = designs();
  sysid::CalibrationSettings settings;
  settings.ranges = ranges;
  settings.start = simulated_side(start);
  settings.start.extensions.clear();
  settings.modulus_budget = 0;
  settings.toughness_budget = budget;
  settings.strength_variation = false;
  settings.seed = seed;
  FractureSearch result;
  const auto keep_run = [&](const sysid::WantedEvaluation& wanted, const std::vector<sysid::Prediction>& predictions) {
    if (wanted.toughness && wanted.items.size() == searched.measured.size())
      result.runs.push_back(run_of(wanted.parameters, predictions, searched.of_group));
  };
  result.best =
      sysid::run_calibration(searched.measured, settings, *simulator_, progress, keep_run).parameters.toughness;
  return result;
}

}  // namespace nacre::diagnosis
