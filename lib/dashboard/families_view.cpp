#include "dashboard/families_view.hpp"

#include "game/family_errors.hpp"
#include "run/adopted_model.hpp"
#include "run/measured_patterns.hpp"

namespace nacre::dashboard {
namespace {

Json values_json(const game::DesignValues& values) {
  return {{"modulus_pa", json_or_null(values.modulus_pa)}, {"toughness_pa", json_or_null(values.toughness_pa)}};
}

Json design_json(const game::FamilyDesign& design, const run::FamilyRecord& family) {
  const std::string key = design.pattern.key();
  const auto crack = family.cracks.find(key);
  return {{"design", key},
          {"is_seed", design.is_seed},
          {"rigid_fraction", design.pattern.rigid_fraction()},
          {"measured", values_json(design.measured)},
          {"global_model", values_json(design.global_model)},
          {"family_model", values_json(design.family_model)},
          {"film", crack != family.cracks.end() && !crack->second.film.empty()}};
}

Json stage_json(const run::FamilyRecord& family) {
  const wire::CalibratedFamily& stated = family.stated;
  const game::FamilyErrors errors = game::family_errors(stated.designs);
  Json designs = Json::array(), over_fits = Json::array(), parameters = Json::object();
  for (const game::FamilyDesign& design : stated.designs) designs.push_back(design_json(design, family));
  for (const auto& [name, value] : run::named_parameters(stated.parameters)) parameters[name] = value;
  if (errors.over_fits_modulus()) over_fits.push_back("E");
  if (errors.over_fits_toughness()) over_fits.push_back("T");
  return {
      {"number", stated.number},
      {"name", stated.name},
      {"round", stated.round},
      {"is_validated", stated.is_validated},
      {"simulations", stated.simulations},
      {"samples", stated.samples},
      {"gamut_count", family.gamut_count},
      {"designs", designs},
      {"errors",
       {{"seeds", {{"global", errors_json(errors.seeds_global)}, {"family", errors_json(errors.seeds_family)}}},
        {"chosen", {{"global", errors_json(errors.chosen_global)}, {"family", errors_json(errors.chosen_family)}}}}},
      {"over_fits", over_fits},
      {"parameters", parameters}};
}

}  // namespace

std::vector<families::MeasuredPattern> measured_members(const run::RunRecord& run) {
  std::vector<families::MeasuredPattern> members;
  for (const auto& each : run::measured_patterns(run, run::newest_round(run).value_or(0)))
    members.push_back({each.pattern, each.mean});
  return members;
}

Json families_json(const run::RunRecord& run, const Grouping& grouping) {
  Json stage = Json::array(), groups = Json::array(), near = Json::array();
  for (const run::FamilyRecord& family : run.families) stage.push_back(stage_json(family));
  for (const families::SeedFamily& group : grouping.families) {
    Json seeds = Json::array();
    for (const pattern::Pattern& seed : group.seeds) seeds.push_back(seed.key());
    groups.push_back({{"name", group.name}, {"seeds", seeds}});
  }
  for (const pattern::Pattern& pattern : grouping.near_pareto) near.push_back(pattern.key());
  return {{"stage", stage},
          {"grouping",
           {{"from", grouping.from}, {"problem", grouping.problem}, {"families", groups}, {"near_pareto", near}}}};
}

}  // namespace nacre::dashboard
