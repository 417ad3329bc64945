#include "report/paper_appendix.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/counted.hpp"
#include "report/report_data.hpp"

namespace nacre::report {
namespace {

Exhibit appendix(const PaperSource& source, const std::string& id, const std::string& heading,
                 std::optional<double> game::DesignValues::*property) {
  Exhibit exhibit{.id = id, .heading = heading};
  std::vector<MeasuredPattern> measured = measured_patterns(source.run, newest_round(source.run).value_or(0));
  if (measured.empty()) {
    exhibit.notes.push_back("No pattern of this run has been measured in both tests yet.");
    return exhibit;
  }
  std::ranges::stable_sort(measured, {}, &MeasuredPattern::round);
  const bool is_modulus = property == &game::DesignValues::modulus_pa;
  const auto value = [&](const std::optional<double>& pa) { return is_modulus ? gpa_cell(pa) : mpa_cell(pa); };
  ExhibitTable table{.name = id,
                     .columns = {{"round", "round", "In which the design was measured first"},
                                 {"number", "no."},
                                 {"design", "design"},
                                 {"rigid_fraction", "rigid fraction"},
                                 {"measured_pa", "measured"}}};
  for (const auto& [model, predicted] : source.predictions) {
    const std::string group = fmt::format("model of round {}", model);
    table.columns.push_back({fmt::format("simulated_pa_r{}", model), "predicted", "", group});
    table.columns.push_back({fmt::format("error_r{}", model), "error", "Relative to the measured value", group});
  }
  int number = 0, missing = 0;
  for (const MeasuredPattern& m : measured) {
    const double truth = is_modulus ? m.mean.modulus_pa : m.mean.toughness_pa;
    std::vector<Cell> row = {text_cell(std::to_string(m.round)), text_cell(std::to_string(++number)),
                             design_cell(m.pattern.key()), share_cell(m.pattern.rigid_fraction()), value(truth)};
    for (const auto& [model, predicted] : source.predictions) {
      const auto found = predicted.find(m.pattern.key());
      const std::optional<double> simulated = found == predicted.end() ? std::nullopt : found->second.*property;
      missing += !simulated;
      row.push_back(value(simulated));
      row.push_back(share_cell(error_of(simulated, truth)));
    }
    table.add(std::move(row));
  }
  exhibit.notes.push_back(
      fmt::format("{}. For designs of a later round a model's column holds out-of-sample predictions, as the thesis' "
                  "blue figures do. Table 3.5 differs: there a proposal's prediction is a mean over realisations.",
                  is_modulus ? "E in GPa" : "T in MPa"));
  if (missing > 0)
    exhibit.notes.push_back(
        fmt::format("–: {} of design and model {} not simulated in this run. The thesis simulates all "
                    "measured designs with its first model, a game of nacre only those that it needs.",
                    counted(missing, "pair"), missing == 1 ? "was" : "were"));
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
