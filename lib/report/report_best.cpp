#include "report/report_best.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "optimize/pareto.hpp"
#include "report/design_picture.hpp"
#include "report/report_data.hpp"
#include "report/report_text.hpp"
#include "report/thesis_figures.hpp"

namespace nacre::report {
namespace {

constexpr int kPictureOfBest = 132, kPictureInRow = 48;  // px

/// The measured front, stiffest first.
std::vector<ComparedDesign> measured_front(const run::RunRecord& run) {
  const std::vector<MeasuredPattern> patterns = measured_patterns(run, newest_round(run).value_or(0));
  const std::vector<optimize::Performance> line = newest_line(run);
  std::vector<optimize::Performance> points;
  for (const MeasuredPattern& m : patterns) points.push_back(m.mean);
  const std::vector<int> ranks = optimize::non_dominated_ranks(points);
  std::vector<ComparedDesign> front;
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    if (ranks[i] == 1) front.push_back({patterns[i], improvement_over(line, patterns[i].mean)});
  }
  std::stable_sort(front.begin(), front.end(), [](const auto& a, const auto& b) {
    return a.measured.mean.modulus_pa > b.measured.mean.modulus_pa;
  });
  return front;
}

/// Of the largest gain in toughness; the toughest where no mixture can be compared with. `front` is not empty.
const ComparedDesign& best_of(const std::vector<ComparedDesign>& front) {
  const auto value = [](const ComparedDesign& design) {
    return std::pair(design.gain.toughness.value_or(0.0), design.measured.mean.toughness_pa);
  };
  return *std::ranges::max_element(front, {}, value);
}

std::string gain_in_words(const ComparedDesign& best) {
  if (!best.gain.toughness) return "The toughest pattern; no mixture of equal stiffness has been measured";
  if (*best.gain.toughness < 1.0)
    return fmt::format(
        "No pattern beats a mixture yet: the best has {:.2f} times the toughness of a mixture of equal "
        "stiffness",
        *best.gain.toughness);
  return fmt::format("{:.2f} times the toughness of a mixture of equal stiffness", *best.gain.toughness);
}

std::string times(const std::optional<double>& factor, std::string_view otherwise) {
  return factor ? fmt::format("{:.2f}×", *factor) : std::string(otherwise);
}

std::string strong(const std::string& html) { return fmt::format("<strong>{}</strong>", html); }

std::string modulus_of(const MeasuredPattern& m) {
  return with_error(m.mean.modulus_pa * 1e-9, m.modulus_sd_pa * 1e-9);
}
std::string toughness_of(const MeasuredPattern& m) {
  return with_error(m.mean.toughness_pa * 1e-6, m.toughness_sd_pa * 1e-6);
}

std::vector<Cell> row_of(const ComparedDesign& design) {
  const MeasuredPattern& m = design.measured;
  return {shown_cell(design_picture(m.pattern, kPictureInRow)),
          shown_cell(design_name(m.pattern.key())),
          shown_cell(fmt::format("{:.0f} %", 100.0 * m.pattern.rigid_fraction())),
          shown_cell(modulus_of(m)),
          shown_cell(toughness_of(m)),
          shown_cell(times(design.gain.modulus, "no mixture has this T")),
          shown_cell(times(design.gain.toughness, "no mixture has this E")),
          shown_cell(fmt::format("{}", m.round))};
}

ExhibitTable empty_table() {
  return {.name = "",
          .columns = {{"", "", ""},
                      {"", "pattern", "Its key; docs/FORMATS.md says how to read it"},
                      {"", "rigid fraction", "Share of rigid pixels"},
                      {"", "E (GPa)", "Young's modulus, mean ± standard deviation of the replicates"},
                      {"", "T (MPa)", "Toughness, mean ± standard deviation of the replicates"},
                      {"", "E, times a mixture's", "Young's modulus over that of the mixture with the same T"},
                      {"", "T, times a mixture's", "Toughness over that of the mixture with the same E"},
                      {"", "measured in round", ""}}};
}

}  // namespace

std::string best_design(const run::RunRecord& run) {
  const std::vector<ComparedDesign> front = measured_front(run);
  if (front.empty()) return "";
  const ComparedDesign& best = best_of(front);
  const MeasuredPattern& m = best.measured;
  const std::size_t count = measured_patterns(run, newest_round(run).value_or(0)).size();
  return fmt::format(
      "<div class=\"best\">{}<div>\n<p class=\"eyebrow\">Best of {} measured {}</p>\n<p class=\"gain\">{}</p>\n"
      "<p>E = {} GPa, T = {} MPa; pattern {}, {:.0f} % rigid, measured in round {}</p>\n"
      "<p class=\"quiet\">Pictures show one unit of 20 × 20 pixels: {}. A <em>mixture</em> has droplets of both inks "
      "placed at random. ±: standard deviation of the replicates. The best design of the thesis has {:.2f} times "
      "the toughness of its mixture.</p>\n</div></div>\n",
      design_picture(m.pattern, kPictureOfBest), count, count == 1 ? "pattern" : "patterns", gain_in_words(best),
      modulus_of(m), toughness_of(m), design_name(m.pattern.key()), 100.0 * m.pattern.rigid_fraction(), m.round,
      phase_legend(), kThesisToughnessGain);
}

Exhibit best_exhibit(const run::RunRecord& run) {
  Exhibit exhibit{.id = "best", .heading = "Best designs against homogeneous mixtures"};
  const std::vector<ComparedDesign> front = measured_front(run);
  if (front.empty()) {
    exhibit.notes.push_back(awaited("the first pattern with both E and T measured"));
    return exhibit;
  }
  ExhibitTable table = empty_table();
  std::optional<double> best_modulus, best_toughness;
  for (const ComparedDesign& design : front) {
    table.add(row_of(design));
    if (design.gain.modulus) best_modulus = std::max(best_modulus.value_or(0.0), *design.gain.modulus);
    if (design.gain.toughness) best_toughness = std::max(best_toughness.value_or(0.0), *design.gain.toughness);
  }
  if (newest_line(run).size() < 2) {
    exhibit.notes.push_back(awaited("the measured line of homogeneous mixtures, which the designs are compared with"));
  } else {
    exhibit.notes.push_back(fmt::format(
        "Largest gain in T over a mixture of the same E: {} (thesis, Table 3.3: {:.2f}×). Largest gain in E over a "
        "mixture of the same T: {} (thesis: {:.2f}×).",
        strong(times(best_toughness, "none, no mixture can be compared with")), kThesisToughnessGain,
        strong(times(best_modulus, "none, no mixture can be compared with")), kThesisModulusGain));
  }
  exhibit.tables.push_back(std::move(table));
  exhibit.fine_print.push_back(
      "The designs of the measured front, stiffest first. Between measured mixtures E and T are read off straight "
      "lines; a design beyond their range has no gain.");
  return exhibit;
}

}  // namespace nacre::report
