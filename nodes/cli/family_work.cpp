#include "family_work.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/files.hpp"
#include "base/output_path.hpp"
#include "explore/gamut_csv.hpp"
#include "families/dense_sampling.hpp"
#include "families/subfamily.hpp"
#include "family_mechanisms.hpp"
#include "game/family_errors.hpp"
#include "game/standings.hpp"
#include "material/parameter_file.hpp"
#include "progress.hpp"
#include "shipped_files.hpp"
#include "sysid/offline.hpp"
#include "tester/specimen_numbers.hpp"
#include "tester/strength_field.hpp"

namespace nacre::cli {
namespace {

using families::SeedFamily;
using pattern::Pattern;

/// A model of one family: its designs weigh 1, the others 0.1.
sysid::Calibrated family_model(const SeedFamily& family, const FamilyData& data, const FamilyOptions& options,
                               sysid::LocalSimulator& simulator) {
  sysid::CalibrationSettings settings;
  settings.ranges = data.ranges;
  settings.start = data.parameters;
  settings.toughness_budget = options.calibration;
  settings.strength_variation = false;  // few designs: that of the whole
  settings.seed = options.seed;
  settings.floor =
      sysid::read_discretisation_floor(discretisation_floor_file(options.discretisation_floor), data.fidelity);
  for (const measurement::Replicates& group : data.measured)
    settings.weights.push_back(families::calibration_weight(family, *game::eightfold_pattern(group.design)));
  Progress progress(family.name + ": calibrating");
  return sysid::run_calibration(data.measured, settings, simulator, [&](double share, std::string_view what) {
    progress.set_share(share, std::string(what));
  });
}

/// Simulates what `known` lacks; failed simulations stay out.
void simulate(const std::string& task, const std::vector<Pattern>& patterns, const material::ParameterSet& parameters,
              sysid::LocalSimulator& simulator, Performances& known) {
  std::vector<measurement::Replicates> wanted;
  for (const Pattern& pattern : patterns) {
    if (known.contains(pattern)) continue;
    wanted.emplace_back().design = pattern;
    wanted.back().modulus_count = wanted.back().toughness_count = 1;
  }
  const int specimens = tester::specimens_differ(parameters) ? tester::kPredictionSpecimens : 1;
  Progress progress(task, (1 + specimens) * static_cast<std::int64_t>(wanted.size()));  // and a modulus test
  const auto predictions = sysid::predict({parameters}, wanted, simulator, [&] { progress.advance(); }).front();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (predictions[i].modulus_pa && predictions[i].toughness_pa)
      known[*game::eightfold_pattern(wanted[i].design)] = {*predictions[i].modulus_pa, *predictions[i].toughness_pa};
  }
}

std::vector<Pattern> sampled_densely(const SeedFamily& family, const FamilyOptions& options) {
  families::DenseSampler sampler(family.seeds, {.seed = options.seed});
  while (static_cast<int>(sampler.members().size()) < options.samples && !sampler.exhausted()) sampler.next();
  return sampler.members();
}

/// Seeds, then the stage's variants; without a stage, sampled now.
std::vector<Pattern> members_of(const SeedFamily& family, const StagedFamily* stage, const FamilyOptions& options) {
  if (stage == nullptr) return sampled_densely(family, options);
  std::vector<Pattern> members = family.seeds;
  for (const explore::Evaluated& variant : stage->variants)
    if (std::ranges::count(family.seeds, variant.pattern) == 0) members.push_back(variant.pattern);
  return members;
}

std::string map_csv(const families::Subfamily& subfamily, const Performances& performances) {
  std::string text = "pattern,source,x,y,x_sampled,y_sampled,rigid_fraction,modulus_pa,toughness_pa\n";
  for (std::size_t i = 0; i < subfamily.members.size(); ++i) {
    const Pattern& pattern = subfamily.members[i];
    const auto found = performances.find(pattern);
    const auto row = subfamily.map.points.row(static_cast<Eigen::Index>(i));
    std::string before = ",";
    if (i < subfamily.sampled) {
      const auto sampled = subfamily.sampled_map.points.row(static_cast<Eigen::Index>(i));
      before = fmt::format("{:.5g},{:.5g}", sampled.x(), sampled.y());
    }
    text += fmt::format("{},{},{:.5g},{:.5g},{},{:.4f}", pattern.key(),
                        i == 0                  ? "seed"
                        : i < subfamily.sampled ? "sampled"
                                                : "interpolated",
                        row.x(), row.y(), before, pattern.rigid_fraction());
    text += found == performances.end()
                ? ",,\n"
                : fmt::format(",{:.6g},{:.6g}\n", found->second.modulus_pa, found->second.toughness_pa);
  }
  return text;
}

nlohmann::ordered_json error_json(int count, double mean) {
  const std::optional<double> error = game::error_over(count, mean);
  return error ? nlohmann::ordered_json(*error) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json errors_json(const sysid::PredictionErrors& errors) {
  return {{"count", std::max(errors.modulus_count, errors.toughness_count)},
          {"E_mean", error_json(errors.modulus_count, errors.modulus_mean)},
          {"T_mean", error_json(errors.toughness_count, errors.toughness_mean)}};
}

/// Errors on the family's own designs.
sysid::PredictionErrors own_errors(const SeedFamily& family, const FamilyData& data,
                                   const material::ParameterSet& parameters, sysid::LocalSimulator& simulator) {
  std::vector<measurement::Replicates> own;
  for (const measurement::Replicates& group : data.measured)
    if (std::ranges::count(family.seeds, *game::eightfold_pattern(group.design)) > 0) own.push_back(group);
  return sysid::prediction_errors(own, sysid::predict({parameters}, own, simulator).front());
}

/// A map of every seed's surroundings, a file each; simulates what was interpolated.
nlohmann::ordered_json mapped(const SeedFamily& family, const std::vector<Pattern>& members,
                              const material::ParameterSet& parameters, const std::filesystem::path& folder,
                              sysid::LocalSimulator& simulator, Performances& performances) {
  nlohmann::ordered_json maps = nlohmann::ordered_json::array();
  for (const Pattern& seed : family.seeds) {
    Progress progress(family.name + ": map of " + seed.key());
    const families::Subfamily subfamily =
        families::subfamily_of(seed, members, {}, [&](double share) { progress.set_share(share, ""); });
    progress.end();
    simulate(family.name + ": interpolated", subfamily.members, parameters, simulator, performances);
    write_file_atomically(folder / (seed.key() + ".csv"), map_csv(subfamily, performances));
    maps.push_back({{"seed", seed.key()},
                    {"sampled", subfamily.sampled},
                    {"interpolated", subfamily.members.size() - subfamily.sampled},
                    {"growth", subfamily.growth()},
                    {"residual_variance", subfamily.map.residual_variance},
                    {"bridges", subfamily.map.bridges}});
  }
  return maps;
}

}  // namespace

nlohmann::ordered_json work_out(const SeedFamily& family, const FamilyData& data, const FamilyOptions& options,
                                const std::filesystem::path& folder, sysid::LocalSimulator& simulator) {
  const StagedFamily* stage = staged(family, data);
  const std::vector<Pattern> members = members_of(family, stage, options);
  for (const Pattern& seed : family.seeds) families::members_near(seed, members);  // before hours of work on them
  prepare_output_folder(folder.string());
  material::ParameterSet parameters = data.parameters;
  nlohmann::ordered_json document = {{"name", family.name}, {"seeds", family.seeds.size()}};
  document["errors_of_the_global_model"] = errors_json(own_errors(family, data, parameters, simulator));
  if (stage != nullptr || options.calibration > 0) {
    parameters =
        stage != nullptr ? stage->stated.parameters : family_model(family, data, options, simulator).parameters;
    document["errors_of_the_family_model"] = errors_json(own_errors(family, data, parameters, simulator));
  }
  write_file_atomically(folder / "parameters.toml", material::to_toml(parameters));
  Performances performances;
  if (stage != nullptr)
    for (const explore::Evaluated& variant : stage->variants) performances[variant.pattern] = variant.performance;
  simulate(family.name + ": dense samples", members, parameters, simulator, performances);
  const nlohmann::ordered_json maps = mapped(family, members, parameters, folder, simulator, performances);
  std::vector<explore::Evaluated> gamut;
  for (const auto& [pattern, performance] : performances) gamut.push_back({pattern, performance});
  explore::write_gamut_csv(folder / "gamut.csv", gamut);
  document["samples"] = gamut.size();
  document["maps"] = maps;
  document["mechanisms"] = mechanisms_of_family(
      broken(family.name + ": cracks", members, options.cracks, parameters, data.fidelity, performances),
      folder / "mechanisms.csv", options.seed);
  return document;
}

}  // namespace nacre::cli
