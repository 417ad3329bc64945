#include "report/fracture_page.hpp"

#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/base64.hpp"
#include "pattern/coupons.hpp"
#include "report/design_picture.hpp"
#include "report/page.hpp"
#include "report/report_figures.hpp"
#include "report/report_text.hpp"
#include "report/svg.hpp"

namespace nacre::report {
namespace {

std::string name_of(const TestedDesign& tested) { return pattern::readable_name(tested.design); }

/// What the main crack does, and what opens beside it; the crack has a path.
std::string crack_in_words(const crack::CrackRecord& crack) {
  const std::string others =
      crack.separate_cracks == 0
          ? ""
          : fmt::format(", while {} elsewhere", crack.separate_cracks == 1
                                                    ? "another crack opens"
                                                    : fmt::format("{} further cracks open", crack.separate_cracks));
  return fmt::format("From the notch the crack runs {}{}",
                     crack.path->crosses ? "through the whole specimen" : "part of the way", others);
}

std::string film_in_page(const BrokenSpecimen& specimen, const std::string& gif) {
  return fmt::format(
      "<img width=\"960\" style=\"max-width: 100%; height: auto\" alt=\"Film: {} is pulled apart\" "
      "src=\"data:image/gif;base64,{}\">\n",
      escaped(name_of(specimen.tested)), base64(gif));
}

std::string curve_figure(const BrokenSpecimen& specimen) {
  const std::vector<PlotPoint> own = curve_points(specimen.tested.fracture.curve),
                               reference = curve_points(specimen.reference.fracture.curve);
  std::vector<PlotPoint> all = own;
  all.insert(all.end(), reference.begin(), reference.end());
  Plot plot({.title = "Pulled to separation, with a notch",
             .x_label = "strain, %",
             .y_label = "nominal stress, MPa",
             .x = range_of(all, &PlotPoint::x),
             .y = range_of(all, &PlotPoint::y),
             .width = 460});
  plot.line(reference, Ink::homogeneous, Stroke::solid, name_of(specimen.reference));
  plot.line(own, Ink::simulated, Stroke::solid, name_of(specimen.tested));
  return plot.svg();
}

ExhibitTable figures_table(const BrokenSpecimen& specimen) {
  ExhibitTable table{.name = "",
                     .columns = {{"", "design"},
                                 {"", "E, GPa", "Young's modulus: how stiff"},
                                 {"", "T, MPa", "Toughness: the area under the curve, MJ/m3"},
                                 {"", "peak stress, MPa"},
                                 {"", "failure strain"}}};
  for (const TestedDesign* each : {&specimen.tested, &specimen.reference})
    table.add({design_cell(each->design.name()), gpa_cell(each->modulus_pa), mpa_cell(each->fracture.toughness_pa),
               mpa_cell(each->fracture.peak_stress_pa), share_cell(each->fracture.failure_strain)});
  return table;
}

Exhibit machine_exhibit(const BrokenSpecimen& specimen) {
  Exhibit exhibit{.id = "curve", .heading = "What the testing machine sees"};
  exhibit.notes.push_back(
      "Toughness T is the area under the curve, the energy that breaks a unit of volume. Stiffness E is tested on a "
      "specimen without a notch.");
  exhibit.figures.push_back({"", curve_figure(specimen)});
  exhibit.figures.push_back({"", design_picture(specimen.tested.design, 200)});
  exhibit.tables.push_back(figures_table(specimen));
  exhibit.fine_print.push_back(phase_legend());
  exhibit.fine_print.push_back(fmt::format(
      "Simulated at fidelity {}, with the parameters of data/defaults.toml; nothing was printed. A specimen repeats "
      "the pattern and has a notch from one edge.",
      tester::to_string(specimen.fidelity)));
  if (specimen.fidelity == tester::Fidelity::tiny)
    exhibit.warnings.push_back(
        "Fidelity tiny: a specimen of a single unit, for tests of the program. The figures mean nothing.");
  return exhibit;
}

}  // namespace

std::string fracture_in_words(const BrokenSpecimen& specimen) {
  const auto ratio = [&](double own, double reference) { return fmt::format("{:.2g}", own / reference); };
  const TestedDesign &tested = specimen.tested, &reference = specimen.reference;
  if (!specimen.crack.path)
    return fmt::format("Nothing breaks up to {:.3g} % of strain.", 100.0 * tested.fracture.failure_strain);
  const std::string crack = crack_in_words(specimen.crack);
  if (tested.design == reference.design) return crack + ".";
  return fmt::format("{}: it takes {} times the energy that breaks {} material alone, at {} times its stiffness.",
                     crack, ratio(tested.fracture.toughness_pa, reference.fracture.toughness_pa), name_of(reference),
                     ratio(tested.modulus_pa, reference.modulus_pa));
}

std::string render_fracture_page(const BrokenSpecimen& specimen, const std::string& gif) {
  const std::string name = name_of(specimen.tested);
  return render_page(
      {.title = "nacre: " + name,
       .eyebrow = name,
       .heading = "A specimen breaks",
       .content = paragraph(escaped(fracture_in_words(specimen)), "standing") + film_in_page(specimen, gif)},
      {machine_exhibit(specimen)});
}

}  // namespace nacre::report
