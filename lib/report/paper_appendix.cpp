// Tables A.3 and A.4: every measured design by every round's model.

#include <algorithm>

#include <fmt/format.h>

#include "report/paper.hpp"
#include "report/report_data.hpp"

namespace nacre::report {
namespace {

Exhibit appendix(const PaperSource& source, const std::string& id, const std::string& heading,
                 std::optional<double> game::DesignValues::*property) {
  Exhibit exhibit{.id = id, .heading = heading, .notes = {}, .figures = {}, .tables = {}};
  std::vector<MeasuredPattern> measured = measured_patterns(source.run, newest_round(source.run).value_or(0));
  if (measured.empty()) {
    exhibit.notes.push_back("No pattern of this run has been measured in both tests yet.");
    return exhibit;
  }
  std::ranges::stable_sort(measured, {}, &MeasuredPattern::round);
  const bool is_modulus = property == &game::DesignValues::modulus_pa;
  const auto value = [&](const std::optional<double>& pa) { return is_modulus ? gpa_cell(pa) : mpa_cell(pa); };
  PaperTable table{.name = id,
                   .columns = {{"round", "R"},
                               {"number", "No."},
                               {"design", "design"},
                               {"rigid_fraction", "VW%"},
                               {"measured_pa", "exp."}},
                   .rows = {},
                   .is_thesis = {},
                   .on_page = true};
  for (const auto& [model, answers] : source.answers) {
    table.columns.push_back(
        {fmt::format("simulated_pa_r{}", model), model == 0 ? "sim. (IR)" : fmt::format("sim. (R{})", model)});
    table.columns.push_back({fmt::format("error_r{}", model), "err."});
  }
  int number = 0, missing = 0;
  for (const MeasuredPattern& m : measured) {
    const double truth = is_modulus ? m.mean.modulus_pa : m.mean.toughness_pa;
    std::vector<Cell> row = {text_cell(std::to_string(m.round)), text_cell(std::to_string(++number)),
                             design_cell(m.pattern.key()), share_cell(m.pattern.rigid_fraction()), value(truth)};
    for (const auto& [model, answers] : source.answers) {
      const auto found = answers.find(m.pattern.key());
      const std::optional<double> simulated = found == answers.end() ? std::nullopt : found->second.*property;
      missing += !simulated;
      row.push_back(value(simulated));
      row.push_back(share_cell(error_of(simulated, truth)));
    }
    table.add(std::move(row));
  }
  exhibit.notes.push_back(
      fmt::format("{}; a model's column beside designs of a later round holds what that model, which does not know "
                  "them, says of them, as the thesis' blue figures. What was foretold of proposals is a mean over "
                  "redraws (Table 3.5).",
                  is_modulus ? "E in GPa" : "T in MPa"));
  if (missing > 0)
    exhibit.notes.push_back(
        fmt::format("– : {} pairs of design and model were not simulated in this run (the thesis simulates all "
                    "measured designs with its first model, a game of nacre only those it needs).",
                    missing));
  exhibit.tables.push_back(std::move(table));
  return exhibit;
}

}  // namespace

Exhibit modulus_appendix(const PaperSource& source) {
  return appendix(source, "table-a-3", "Table A.3: E of all measured designs by the models of all rounds",
                  &game::DesignValues::modulus_pa);
}

Exhibit toughness_appendix(const PaperSource& source) {
  return appendix(source, "table-a-4", "Table A.4: T of all measured designs by the models of all rounds",
                  &game::DesignValues::toughness_pa);
}

}  // namespace nacre::report
