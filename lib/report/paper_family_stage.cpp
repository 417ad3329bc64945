#include "report/paper_family_stage.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "game/family_errors.hpp"
#include "report/report_data.hpp"
#include "report/report_figures.hpp"
#include "report/report_text.hpp"
#include "report/svg.hpp"

namespace nacre::report {
namespace {

const std::string kNoStage =
    "This run played no family stage: <code>[families] enabled = true</code> in its scenario asks for one "
    "(launch/README.md).";

/// A family of the run or of the thesis with what Tables A.5 and A.6 say of it.
struct StatedFamily {
  std::string name;
  bool is_thesis = false, is_validated = true;
  std::vector<game::FamilyDesign> designs;
};

std::vector<StatedFamily> families_of_run(const PaperSource& source) {
  std::vector<StatedFamily> all;
  for (const run::FamilyRecord& family : source.run.families)
    all.push_back({family.stated.name, false, family.stated.is_validated, family.stated.designs});
  return all;
}

std::vector<StatedFamily> families_of_thesis(const PaperSource& source) {
  std::vector<StatedFamily> all;
  for (const game::ThesisFamilySample& sample : source.thesis.families) {
    const std::string name = fmt::format("thesis {}", sample.family);
    if (all.empty() || std::ranges::find(all, name, &StatedFamily::name) == all.end())
      all.push_back({name, true, true, {}});
    std::ranges::find(all, name, &StatedFamily::name)
        ->designs.push_back({.pattern = {},
                             .is_seed = sample.is_seed,
                             .measured = sample.measured,
                             .global_model = sample.global_model,
                             .family_model = sample.family_model});
  }
  return all;
}

std::vector<StatedFamily> all_families(const PaperSource& source) {
  std::vector<StatedFamily> all = families_of_run(source);
  for (StatedFamily& family : families_of_thesis(source)) all.push_back(std::move(family));
  return all;
}

/// Designs that a model's errors are of, in E or in T.
int designs_of(const sysid::PredictionErrors& errors) { return std::max(errors.modulus_count, errors.toughness_count); }

/// Table 3.6 (seeds) or 3.7 (chosen designs).
ExhibitTable errors_table(const PaperSource& source, const std::string& name, bool seeds) {
  constexpr const char* kGlobal = "Relative error of the model that is calibrated on all families";
  constexpr const char* kOwn = "Relative error of the model that is calibrated on this family";
  ExhibitTable table{.name = name,
                     .columns = {{"family", "family"},
                                 {"count", "designs", "How many designs the errors are of"},
                                 {"modulus_global_mean", "mean", kGlobal, "E, global model"},
                                 {"modulus_global_max", "max", kGlobal, "E, global model"},
                                 {"modulus_family_mean", "mean", kOwn, "E, family's model"},
                                 {"modulus_family_max", "max", kOwn, "E, family's model"},
                                 {"toughness_global_mean", "mean", kGlobal, "T, global model"},
                                 {"toughness_global_max", "max", kGlobal, "T, global model"},
                                 {"toughness_family_mean", "mean", kOwn, "T, family's model"},
                                 {"toughness_family_max", "max", kOwn, "T, family's model"}}};
  for (const StatedFamily& family : all_families(source)) {
    const game::FamilyErrors errors = game::family_errors(family.designs);
    const sysid::PredictionErrors& global = seeds ? errors.seeds_global : errors.chosen_global;
    const sysid::PredictionErrors& own = seeds ? errors.seeds_family : errors.chosen_family;
    const int count = std::max(designs_of(global), designs_of(own));
    if (!family.is_thesis && count == 0) continue;
    table.add(
        {text_cell(family.name), text_cell(std::to_string(count)),
         error_cell(global.modulus_count, global.modulus_mean), error_cell(global.modulus_count, global.modulus_max),
         error_cell(own.modulus_count, own.modulus_mean), error_cell(own.modulus_count, own.modulus_max),
         error_cell(global.toughness_count, global.toughness_mean),
         error_cell(global.toughness_count, global.toughness_max), error_cell(own.toughness_count, own.toughness_mean),
         error_cell(own.toughness_count, own.toughness_max)},
        family.is_thesis ? TableRowKind::thesis : TableRowKind::own);
  }
  return table;
}

/// Table A.5 (E) or A.6 (T).
Exhibit appendix(const PaperSource& source, const std::string& id, const std::string& heading,
                 std::optional<double> game::DesignValues::*property) {
  Exhibit exhibit{.id = id, .heading = heading};
  const bool is_modulus = property == &game::DesignValues::modulus_pa;
  const auto value = [&](const std::optional<double>& pa) { return is_modulus ? gpa_cell(pa) : mpa_cell(pa); };
  ExhibitTable table{.name = id,
                     .columns = {{"family", "family"},
                                 {"role", "role"},
                                 {"design", "design"},
                                 {"rigid_fraction", "rigid fraction"},
                                 {"measured_pa", "measured"},
                                 {"global_pa", "predicted", "", "global model"},
                                 {"global_error", "error", "Relative to the measured value", "global model"},
                                 {"family_pa", "predicted", "", "family's model"},
                                 {"family_error", "error", "Relative to the measured value", "family's model"}}};
  for (const StatedFamily& family : families_of_run(source)) {
    for (const game::FamilyDesign& d : family.designs) {
      table.add({text_cell(family.name), text_cell(d.is_seed ? "seed" : "validation"), design_cell(d.pattern.key()),
                 share_cell(d.pattern.rigid_fraction()), value(d.measured.*property), value(d.global_model.*property),
                 share_cell(error_of(d.global_model.*property, d.measured.*property)), value(d.family_model.*property),
                 share_cell(error_of(d.family_model.*property, d.measured.*property))});
    }
  }
  if (table.rows.empty()) {
    exhibit.notes.push_back(kNoStage);
    return exhibit;
  }
  exhibit.notes.push_back(
      fmt::format("{}. Both predictions of the validation designs are out-of-sample. –: not measured (rejected, or no "
                  "valid specimen), or not simulated.",
                  is_modulus ? "E in GPa" : "T in MPa"));
  exhibit.tables.push_back(std::move(table));
  return exhibit;
}

/// Mean errors of the global and of the family's own models on the seeds, family by family; nothing where no family has
/// any.
std::optional<std::string> seed_error_figure(const PaperSource& source, bool toughness) {
  std::vector<PlotPoint> global, own;
  double place = 0.0;
  const auto add = [&](std::vector<PlotPoint>& points, const sysid::PredictionErrors& e) {
    const auto mean = toughness ? game::error_over(e.toughness_count, e.toughness_mean)
                                : game::error_over(e.modulus_count, e.modulus_mean);
    if (mean) points.push_back({place, 100.0 * *mean});
  };
  for (const StatedFamily& family : families_of_run(source)) {
    const game::FamilyErrors errors = game::family_errors(family.designs);
    place += 1.0;
    add(global, errors.seeds_global);
    add(own, errors.seeds_family);
  }
  std::vector<PlotPoint> both = global;
  both.insert(both.end(), own.begin(), own.end());
  if (both.empty()) return std::nullopt;
  Plot plot({.title = toughness ? "Toughness" : "Young's modulus",
             .x_label = "family",
             .y_label = "mean relative error (%)",
             .x = {0.5, place + 0.5},
             .y = range_of(both, &PlotPoint::y),
             .width = 350,
             .height = 260,
             .whole_numbers_x = true});
  plot.dots(global, Ink::earlier, "global model");
  plot.dots(own, Ink::simulated, "family's model");
  return plot.svg();
}

/// Whether the families' own models over-fit, by family and property, as the page says it.
struct OverFitting {
  std::vector<std::string> over_fitted, open;  ///< "family-1 (T)", "family-2 (E not measured)"
  int sound = 0;
  bool waiting = false;  ///< a family whose designs are being measured
};

/// Why two models cannot be compared in a property.
std::string_view what_is_missing(const StatedFamily& family, std::optional<double> game::DesignValues::*property) {
  const auto is_measured = [&](bool seeds) {
    return std::ranges::any_of(family.designs, [&](const game::FamilyDesign& design) {
      return design.is_seed == seeds && (design.measured.*property).has_value();
    });
  };
  return is_measured(true) && is_measured(false) ? "not simulated" : "not measured";
}

OverFitting over_fitting_of(const std::vector<StatedFamily>& families) {
  OverFitting found;
  for (const StatedFamily& family : families) {
    const game::FamilyErrors errors = game::family_errors(family.designs);
    const auto judge = [&](char letter, bool over_fits, bool is_judged,
                           std::optional<double> game::DesignValues::*property) {
      if (over_fits)
        found.over_fitted.push_back(fmt::format("{} ({})", escaped(family.name), letter));
      else if (is_judged)
        ++found.sound;
      else if (family.is_validated)
        found.open.push_back(
            fmt::format("{} ({} {})", escaped(family.name), letter, what_is_missing(family, property)));
    };
    judge('T', errors.over_fits_toughness(), errors.judges_toughness(), &game::DesignValues::toughness_pa);
    judge('E', errors.over_fits_modulus(), errors.judges_modulus(), &game::DesignValues::modulus_pa);
    found.waiting = found.waiting || !family.is_validated;
  }
  return found;
}

std::optional<PlotPoint> point_of(const game::DesignValues& values) {
  if (!values.modulus_pa || !values.toughness_pa) return std::nullopt;
  return to_point({*values.modulus_pa, *values.toughness_pa});
}

/// What the axes of Figure 3-15 must hold.
std::vector<PlotPoint> variants_and_measured(const PaperSource& source) {
  std::vector<PlotPoint> all;
  for (const run::FamilyRecord& family : source.run.families) {
    for (const optimize::Performance& each : gamut_of(family).performances) all.push_back(to_point(each));
    for (const game::FamilyDesign& design : family.stated.designs)
      if (const auto point = point_of(design.measured)) all.push_back(*point);
  }
  return all;
}

ExhibitTable variant_table(const PaperSource& source) {
  ExhibitTable table{
      .name = "figure-3-15",
      .columns = {{"family", ""}, {"what", ""}, {"pattern", ""}, {"modulus_pa", ""}, {"toughness_pa", ""}},
      .on_page = false};
  for (const run::FamilyRecord& family : source.run.families) {
    const run::Gamut& gamut = gamut_of(family);
    for (std::size_t i = 0; i < gamut.patterns.size(); ++i)
      table.add({text_cell(family.stated.name), text_cell("variant"),
                 text_cell(pattern::Pattern(gamut.patterns[i]).key()), gpa_cell(gamut.performances[i].modulus_pa),
                 mpa_cell(gamut.performances[i].toughness_pa)});
  }
  return table;
}

std::string gamut_figure(const run::FamilyRecord& family, Ink ink, const Range& x, const Range& y) {
  std::vector<PlotPoint> seeds, chosen, predicted;
  for (const game::FamilyDesign& design : family.stated.designs) {
    if (const auto point = point_of(design.measured)) (design.is_seed ? seeds : chosen).push_back(*point);
    if (const auto point = point_of(design.family_model); point && !design.is_seed) predicted.push_back(*point);
  }
  Plot plot({.title = family.stated.name,
             .x_label = "Young's modulus E (GPa)",
             .y_label = "toughness T (MPa)",
             .x = x,
             .y = y,
             .width = 460,
             .height = 340});
  plot.cloud(to_points(thinned(gamut_of(family).performances, kMostGamutPoints)), ink, "variants");
  plot.dots(seeds, Ink::earlier, "seeds, measured");
  plot.rings(predicted, ink, "chosen, predicted");
  plot.dots(chosen, Ink::measured, "chosen, measured");
  return plot.svg();
}

}  // namespace

Exhibit seed_error_exhibit(const PaperSource& source) {
  Exhibit exhibit{.id = "figure-3-14", .heading = "Figure 3-14, Table 3.6: Global and family models on the seeds"};
  if (source.run.families.empty())
    exhibit.notes.push_back(kNoStage + " The thesis' figures:");
  else
    exhibit.notes.push_back(
        "A family's model is calibrated on its seeds with weight 1 (on the other near-Pareto designs with 0.1). A "
        "small "
        "error here proves nothing yet: Table 3.7 is the test.");
  for (const bool toughness : {false, true}) {
    if (auto svg = seed_error_figure(source, toughness))
      exhibit.figures.push_back({toughness ? "figure-3-14-toughness" : "figure-3-14-modulus", std::move(*svg)});
  }
  exhibit.tables.push_back(errors_table(source, "table-3-6", true));
  return exhibit;
}

Exhibit family_gamut_exhibit(const PaperSource& source) {
  Exhibit exhibit{.id = "figure-3-15", .heading = "Figure 3-15: Gamuts of the families"};
  if (source.run.families.empty()) {
    exhibit.notes.push_back(kNoStage);
    return exhibit;
  }
  const std::vector<PlotPoint> all = variants_and_measured(source);
  const Range x = range_of(all, &PlotPoint::x), y = range_of(all, &PlotPoint::y);
  std::size_t variants = 0;
  for (std::size_t f = 0; f < source.run.families.size(); ++f) {
    const run::FamilyRecord& family = source.run.families[f];
    variants += gamut_of(family).patterns.size();
    exhibit.figures.push_back({"figure-3-15-" + family.stated.name, gamut_figure(family, family_ink(f), x, y)});
  }
  exhibit.notes.push_back(
      fmt::format("Variants within 16 pixels of a seed by the family's own model, {} in all (the thesis: 7000 to 9000 "
                  "per family), and the designs chosen of them (2.3.4).",
                  variants));
  exhibit.tables.push_back(variant_table(source));
  return exhibit;
}

Exhibit validation_exhibit(const PaperSource& source) {
  Exhibit exhibit{.id = "table-3-7", .heading = "Table 3.7: Global and family models on the validation designs"};
  if (source.run.families.empty()) exhibit.notes.push_back(kNoStage + " The thesis' figures:");
  const auto [over_fitted, open, sound, waiting] = over_fitting_of(families_of_run(source));
  if (waiting) exhibit.notes.push_back("Some families are not validated yet: their designs are being measured.");
  if (!open.empty())
    exhibit.notes.push_back(
        fmt::format("<strong>No verdict: {}</strong>: no seed or no validation design has a measurement (rejected, or "
                    "no valid specimen), or a model could not simulate them.",
                    fmt::join(open, ", ")));
  if (!over_fitted.empty())
    exhibit.notes.push_back(
        fmt::format("<strong>Over-fitted: {}</strong>: nearer to the seeds than the global model and farther from the "
                    "validation designs, as in three of the thesis' four families. Trust the global model there.",
                    fmt::join(over_fitted, ", ")));
  else if (sound > 0 && !waiting)
    exhibit.notes.push_back(
        fmt::format("{} family's model over-fits: none is nearer to its seeds than the global one and farther from its "
                    "validation designs. (In the thesis all but one did, in T.)",
                    open.empty() ? "No" : "Of what could be compared, no"));
  exhibit.tables.push_back(errors_table(source, "table-3-7", false));
  return exhibit;
}

Exhibit family_modulus_appendix(const PaperSource& source) {
  return appendix(source, "table-a-5", "Table A.5: E of the designs of the family stage",
                  &game::DesignValues::modulus_pa);
}

Exhibit family_toughness_appendix(const PaperSource& source) {
  return appendix(source, "table-a-6", "Table A.6: T of the designs of the family stage",
                  &game::DesignValues::toughness_pa);
}

}  // namespace nacre::report
