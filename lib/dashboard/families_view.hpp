#pragma once
// The families of a run: results of the family stage, and how designs are grouped now.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dashboard/json_parts.hpp"
#include "families/grouping.hpp"
#include "run/adopted_model.hpp"
#include "run/run_record.hpp"

namespace nacre::dashboard {

/// Which measured designs belong together, and where the grouping comes from.
struct Grouping {
  static constexpr std::string_view kPageName = "Grouping";
  static constexpr std::string_view kOrigins[] = {"file", "proposal"};
  std::vector<families::SeedFamily> families;
  std::vector<pattern::Pattern> near_pareto;  ///< what a person may choose from
  std::string from;                           ///< `file` (families.toml) or `proposal`
  std::string problem;                        ///< why the file is not used; empty when it is, or when there is none

  static void fields(auto& field, auto& m);
};

/// The patterns that the run has measured in both tests.
std::vector<families::MeasuredPattern> measured_members(const run::RunRecord& run);

/// E and T as far as they are known.
struct ValuesRow {
  static constexpr std::string_view kPageName = "Values";
  game::DesignValues values;

  static void fields(auto& field, auto& m) {
    field("modulus_pa", m.values.modulus_pa);
    field("toughness_pa", m.values.toughness_pa);
  }
};

struct FamilyDesignRow {
  static constexpr std::string_view kPageName = "FamilyDesign";
  game::FamilyDesign design;
  bool has_film = false;

  static void fields(auto& field, auto& m) {
    field("design", m.design.pattern);
    field("is_seed", m.design.is_seed);
    field("rigid_fraction", m.design.pattern.rigid_fraction());
    field("measured", ValuesRow{m.design.measured});
    field("global_model", ValuesRow{m.design.global_model});
    field("family_model", ValuesRow{m.design.family_model});
    field("film", m.has_film);
  }
};

/// Errors of both models.
struct ModelErrorsRow {
  static constexpr std::string_view kPageName = "ModelErrors";
  sysid::PredictionErrors global, family;

  static void fields(auto& field, auto& m) {
    field("global", m.global);
    field("family", m.family);
  }
};

struct FamilyErrorsRow {
  static constexpr std::string_view kPageName = "FamilyErrors";
  game::FamilyErrors errors;

  static void fields(auto& field, auto& m) {
    field("seeds", ModelErrorsRow{m.errors.seeds_global, m.errors.seeds_family});
    field("chosen", ModelErrorsRow{m.errors.chosen_global, m.errors.chosen_family});
  }
};

struct FamilyRow {
  static constexpr std::string_view kPageName = "Family";
  const run::FamilyRecord* family = &nothing<run::FamilyRecord>();
  std::vector<FamilyDesignRow> designs;
  FamilyErrorsRow errors;
  std::vector<std::string> over_fits;  ///< E, T

  static void fields(auto& field, auto& m) {
    const wire::CalibratedFamily& stated = m.family->stated;
    field("number", stated.number);
    field("name", stated.name);
    field("round", stated.round);
    field("is_validated", stated.is_validated);
    field("simulations", stated.simulations);
    field("samples", stated.samples);
    field("gamut_count", m.family->gamut_count);
    field("designs", m.designs);
    field("errors", m.errors);
    field("over_fits", m.over_fits);
    field("parameters", run::named_parameters(stated.parameters));
  }
};

struct SeedFamilyRow {
  static constexpr std::string_view kPageName = "NamedSeeds";
  const families::SeedFamily* family = &nothing<families::SeedFamily>();

  static void fields(auto& field, auto& m) {
    field("name", m.family->name);
    field("seeds", m.family->seeds);
  }
};

void Grouping::fields(auto& field, auto& m) {
  field("from", m.from, OneOf{kOrigins});
  field("problem", m.problem);
  field("families", rows_of<SeedFamilyRow>(m.families));
  field("near_pareto", m.near_pareto);
}

/// Families of the stage after the game with designs, errors of both models and whether they over-fit; and the
/// grouping. `enabled`: the scenario has the stage.
struct FamiliesRow {
  static constexpr std::string_view kPageName = "Families";
  bool enabled = false;
  std::vector<FamilyRow> stage;
  Grouping grouping;

  static void fields(auto& field, auto& m) {
    field("enabled", m.enabled);
    field("stage", m.stage);
    field("grouping", m.grouping);
  }
};
/// Refers to the record.
FamiliesRow families_row(const run::RunRecord& run, Grouping grouping, bool enabled);

}  // namespace nacre::dashboard
