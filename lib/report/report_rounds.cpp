#include "report/report_rounds.hpp"

#include "report/report_figures.hpp"
#include "report/report_standing.hpp"

namespace nacre::report {
namespace {

void add_figures(Exhibit& exhibit, std::vector<std::string> svgs) {
  for (std::string& svg : svgs) exhibit.figures.push_back({"", std::move(svg)});
}

}  // namespace

Exhibit gamut_exhibit(const run::RunRecord& run) {
  Exhibit exhibit{.id = "gamuts", .heading = "Simulation and measurements, round by round"};
  add_figures(exhibit, gamut_figures(run));
  if (exhibit.figures.empty()) {
    exhibit.notes.push_back(awaited("the first gamut: the patterns that the first search simulates"));
    return exhibit;
  }
  exhibit.notes.push_back(
      "Simulated by the model of each round (blue) and measured until then (orange), on the same axes. The staircase "
      "of a front bounds what it dominates; the area between the two staircases is the gap between simulation and "
      "laboratory.");
  if (const std::string machine = machine_in_words(run); !machine.empty()) exhibit.notes.push_back(machine);
  exhibit.fine_print.push_back("Bars: ± 1 standard deviation of the replicates.");
  return exhibit;
}

Exhibit round_exhibit(const run::RunRecord& run) {
  Exhibit exhibit{.id = "rounds", .heading = "Hypervolume and gap"};
  add_figures(exhibit, round_figures(run));
  if (exhibit.figures.empty()) {
    exhibit.notes.push_back(awaited("the end of round 0"));
    return exhibit;
  }
  exhibit.notes.push_back(
      "The hypervolume of a front is the area under its staircase, down to E = 0 and T = 0: one number for how good it "
      "is. The gap is the area between the two fronts: how far simulation and laboratory are apart.");
  exhibit.fine_print.push_back(
      "The error is the bootstrap standard error over replicates. The game is in equilibrium when two rounds running "
      "add nothing: the measured hypervolume grows by less than its error, and the signed gap lies within twice that "
      "error or changes by less than 10 %.");
  return exhibit;
}

Exhibit curve_exhibit(const run::RunRecord& run) {
  Exhibit exhibit{.id = "curves", .heading = "Stress-strain curves"};
  add_figures(exhibit, curve_figures(run));
  if (exhibit.figures.empty()) {
    exhibit.notes.push_back(awaited("the first measured curve of a pattern"));
    return exhibit;
  }
  exhibit.notes.push_back(
      "Notched specimens printed upright: every measured replicate (orange), and the newest model's curve (blue) as "
      "the testing machine would record it. Designs measured last come first; all plots share their axes.");
  return exhibit;
}

}  // namespace nacre::report
