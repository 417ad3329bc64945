#include "dashboard/families_view.hpp"

#include "run/measured_patterns.hpp"

namespace nacre::dashboard {
namespace {

FamilyRow family_row(const run::FamilyRecord& family) {
  const game::FamilyErrors errors = game::family_errors(family.stated.designs);
  FamilyRow row{&family, {}, {errors}, {}};
  for (const game::FamilyDesign& design : family.stated.designs) {
    const auto crack = family.cracks.find(design.pattern.key());
    row.designs.push_back({design, crack != family.cracks.end() && !crack->second.film.empty()});
  }
  if (errors.over_fits_modulus()) row.over_fits.emplace_back("E");
  if (errors.over_fits_toughness()) row.over_fits.emplace_back("T");
  return row;
}

}  // namespace

std::vector<families::MeasuredPattern> measured_members(const run::RunRecord& run) {
  std::vector<families::MeasuredPattern> members;
  for (const auto& each : run::measured_patterns(run, run::newest_round(run).value_or(0)))
    members.push_back({each.pattern, each.mean});
  return members;
}

FamiliesRow families_row(const run::RunRecord& run, Grouping grouping, bool enabled) {
  FamiliesRow row{enabled, {}, std::move(grouping)};
  for (const run::FamilyRecord& family : run.families) row.stage.push_back(family_row(family));
  return row;
}

}  // namespace nacre::dashboard
