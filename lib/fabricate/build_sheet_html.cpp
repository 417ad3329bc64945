#include "fabricate/build_sheet_html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "fabricate/price.hpp"
#include "fabricate/slice_png.hpp"
#include "pattern/coupons.hpp"
#include "pattern/phase_colours.hpp"

namespace nacre::fabricate {
namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Build sheet {0}</title><style>
body {{ font: 15px/1.5 system-ui, sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1rem; color: #1b1f24; }}
table {{ border-collapse: collapse; margin: .5rem 0 1.5rem; }}
th, td {{ border: 1px solid #c8ccd2; padding: .25rem .6rem; text-align: left; vertical-align: top; }}
td.n {{ text-align: right; font-variant-numeric: tabular-nums; }}
code {{ overflow-wrap: anywhere; }}
.swatch {{ display: inline-block; width: .9em; height: .9em; margin: 0 .3em 0 .8em; vertical-align: -.1em; }}
img {{ max-width: 100%; border: 1px solid #c8ccd2; }}
</style></head><body>
<h1>Build sheet {0}</h1>
)";

std::string escaped(std::string_view text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '&') {
      result += "&amp;";
    } else if (letter == '<') {
      result += "&lt;";
    } else {
      result += letter;
    }
  }
  return result;
}

std::string settings(const Job& job, const Resin& resin) {
  const JobRequest& request = job.request;
  const Printer& printer = request.printer;
  return fmt::format(
      "<p>{}.</p>\n"
      "<p>Hours: at {:g} layers a minute, {:g} min a test. Resin in the slices: {:.0f} ml soft, {:.0f} ml rigid; "
      "support "
      "and purging come on top.</p>\n"
      "<p>{} models, trays of {} x {} mm. Interface: {}. Grips: {}. Seed {}.</p>\n",
      in_words(price_of(job)), request.rates.layers_per_minute, request.rates.minutes_per_test, resin.soft_ml,
      resin.rigid_ml, job.models.size(), printer.tray_x_mm, printer.tray_y_mm,
      request.interface == Interface::engineered ? "engineered" : "sharp",
      request.grips == GripMaterial::pattern ? "the pattern" : "rigid", request.seed);
}

std::string legend_entry(std::uint32_t rgb, const char* name) {
  return fmt::format("<span class=swatch style=\"background:{}\"></span>{}", pattern::html_colour(rgb), name);
}

std::string colour_in_files(const Printer& printer, std::uint32_t rgb, int index, const char* what) {
  const std::string colour =
      printer.pixels == SlicePixels::rgba
          ? fmt::format("{} ({}, {}, {})", pattern::html_colour(rgb), rgb >> 16, rgb >> 8 & 0xff, rgb & 0xff)
          : fmt::format("palette index {}", index);
  return fmt::format("<td><span class=swatch style=\"background:{}\"></span>{}: {}</td>", pattern::html_colour(rgb),
                     what, colour);
}

std::string tray_stacks(const Job& job, const WrittenJob& written) {
  if (!job.request.tray_stacks) return "<p>Load each model's stack as often as it has copies.</p>\n";
  std::string rows;
  for (int tray = 1; tray <= job.trays; ++tray) {
    const WrittenTray& stack = written.trays[tray - 1];
    const Printer& printer = job.request.printer;
    rows += fmt::format(
        "<tr><td class=n>{0}</td><td><code>trays/{0}/slices/</code> {1} slices of {2} x {3}</td><td class=n>{4:.1f} x "
        "{5:.1f} x {6:.2f}</td><td class=n>{7:g}, {8:g}</td></tr>\n",
        tray, stack.count.layers, stack.count.columns, stack.count.rows, stack.count.columns * pitch_mm(printer.dpi_x),
        stack.count.rows * pitch_mm(printer.dpi_y), stack.count.layers * pitch_mm(printer.dpi_z), stack.corner_x_mm,
        stack.corner_y_mm);
  }
  return "<p>Load one stack a tray, or each model's as often as it has copies.</p>\n<table><tr><th>tray</th>"
         "<th>slices</th><th>size that must be shown, mm</th><th>front left corner, mm</th></tr>\n" +
         rows + "</table>\n";
}

std::string into_the_printer(const Job& job, const WrittenJob& written) {
  const Printer& printer = job.request.printer;
  const SliceColours colours = colours_of(printer.pixels);
  return fmt::format(
             "<h2>Into the printer</h2>\n<p>One PNG a layer, the lowest first: {0} x {1} dpi (x, y), layers of {2:.2f} "
             "um. Show the printer's software these, and compare the sizes that it shows: exchanged axes are off by "
             "{3:g}.</p>\n<table><tr>{4}{5}{6}</tr></table>\n",
             printer.dpi_x, printer.dpi_y, 1e3 * pitch_mm(printer.dpi_z),
             static_cast<double>(std::max(printer.dpi_x, printer.dpi_y)) / std::min(printer.dpi_x, printer.dpi_y),
             colour_in_files(printer, colours.rigid, 2, "rigid resin"),
             colour_in_files(printer, colours.soft, 1, "soft resin"),
             colour_in_files(printer, colours.none, 0, "nothing, or support")) +
         tray_stacks(job, written);
}

std::string models_table(const Job& job, const WrittenJob& written) {
  std::string rows;
  for (std::size_t i = 0; i < job.models.size(); ++i) {
    const PrintModel& model = job.models[i];
    const std::string folder = written.models[i].folder.empty() ? "" : written.models[i].folder + "/";
    rows += fmt::format(
        "<tr><td><a href=\"{0}preview.png\">{1}</a></td><td><code>{2}</code></td><td>{3}</td><td class=n>{4}</td>"
        "<td class=n>{5:g} x {6:g} x {7:g}</td><td><code>{0}slices/</code> {8} slices of {9} x {10}</td>"
        "<td class=n>{11:.4f}</td><td class=n>{12:.4f}</td><td class=n>{13:.2f}</td><td>{14}</td></tr>\n",
        folder, escaped(model.name), escaped(pattern::readable_name(model.wanted.design)),
        tester::to_string(model.wanted.test), model.wanted.replicates, model.size_x_mm, model.size_y_mm,
        model.size_z_mm, written.models[i].count.layers, written.models[i].count.columns, written.models[i].count.rows,
        model.wanted.design.rigid_fraction(), rigid_fraction(written.models[i].count.total),
        test_speed_mm_per_min(model.wanted), escaped(pull_in_words(model.wanted.loading)));
  }
  return "<h2>Models</h2>\n<p>Colours of pictures (preview.png):" + legend_entry(pattern::kRigidRgb, "rigid") +
         legend_entry(pattern::kSoftRgb, "soft") + legend_entry(pattern::kNotPrintedRgb, "not printed") +
         "</p>\n<table><tr><th>model</th><th>design</th><th>test</th><th>copies</th><th>size, mm</th>"
         "<th>slices</th><th>rigid, designed</th><th>rigid, counted in the slices</th><th>test speed, "
         "mm/min</th><th>pull</th></tr>"
         "\n" +
         rows + "</table>\n";
}

std::string trays(const Job& job) {
  std::string text =
      "<h2>Trays</h2>\n<p>Front of the printer at the bottom, x to the right. The number that ends a label is the "
      "print "
      "order.</p>\n";
  for (int tray = 1; tray <= job.trays; ++tray)
    text += fmt::format("<h3>Tray {0}, batch {1}</h3>\n<img src=\"trays/{0}/preview.png\" alt=\"Tray {0}\">\n", tray,
                        escaped(job.batch(tray)));
  return text;
}

std::string specimens_table(const Job& job) {
  std::string rows;
  for (const PlacedSpecimen& specimen : job.specimens) {
    const PrintModel& model = job.models[specimen.model];
    rows += fmt::format(
        "<tr><td class=n>{}</td><td><b>{}</b></td><td>{}</td><td class=n>{}</td><td class=n>{}</td>"
        "<td class=n>{:.1f}</td><td class=n>{:.1f}</td></tr>\n",
        specimen.print_order, escaped(specimen.label), escaped(model.name), specimen.replicate, specimen.tray,
        specimen.x_mm, specimen.y_mm);
  }
  return "<h2>Specimens</h2>\n<p>Write the label on the grip when the specimen leaves the tray.</p>\n"
         "<table><tr><th>order</th><th>label</th><th>model</th><th>copy</th><th>tray</th><th>x, mm</th><th>y, mm</th>"
         "</tr>\n" +
         rows + "</table>\n";
}

std::string instructions(const Job& job) {
  const bool cut = job.request.notch.print_cut;
  return fmt::format(
      "<h2>After printing</h2>\n<ol>\n"
      "<li>Label, clean off the support, dry at room temperature, cure both sides alike with UV light.</li>\n"
      "<li>Toughness specimens: clean the notch with a new razor blade{}.</li>\n"
      "<li>Measure width and thickness of each specimen in the gauge and put them into <code>specimens.csv</code>, "
      "with "
      "date, operator and machine.</li>\n"
      "<li>Pull at the speed above. Toughness: grips 54 mm apart, to complete separation. Modulus and tensile (ASTM "
      "D638 type I): grips 115 mm apart; <code>gauge_mm</code> is the extensometer's gauge (50), or {:.1f} where only "
      "the travel of the grips is recorded. Where <i>pull</i> above names strains, go from one to the next at that "
      "speed "
      "and record unloading too, in one file.</li>\n"
      "<li>Export time, extension and force of each test as CSV, name the files in the column <code>file</code>, note "
      "under <code>path</code> the path of the crack (any word, the same word for the same path), then "
      "<code>nacre import *.csv --specimens specimens.csv --out SET</code>.</li>\n</ol>\n",
      cut ? "" : ", then mill a triangular cut of 60 degrees, 7.8 mm deep, on the notch's axis",
      bar_effective_gauge_mm());
}

}  // namespace

std::string build_sheet_html(const Job& job, const WrittenJob& written) {
  return fmt::format(kHead, escaped(job.request.name)) + settings(job, resin_of(job, written)) +
         into_the_printer(job, written) + models_table(job, written) + trays(job) + specimens_table(job) +
         instructions(job) + "</body></html>\n";
}

}  // namespace nacre::fabricate
