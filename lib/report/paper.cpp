#include "report/paper.hpp"

#include "base/files.hpp"
#include "report/design_picture.hpp"
#include "report/page.hpp"
#include "report/paper_appendix.hpp"
#include "report/paper_families.hpp"
#include "report/paper_family_stage.hpp"
#include "report/paper_game.hpp"
#include "report/paper_maps.hpp"
#include "report/paper_search.hpp"
#include "report/report_standing.hpp"
#include "report/standalone.hpp"

namespace nacre::report {

std::vector<Exhibit> exhibits_of(const PaperSource& source) {
  return {gamut_exhibit(source),         hypervolume_exhibit(source),     best_exhibit(source),
          base_material_exhibit(source), error_exhibit(source),           search_exhibit(source),
          family_exhibit(source),        family_curve_exhibit(source),    seed_error_exhibit(source),
          family_gamut_exhibit(source),  validation_exhibit(source),      map_exhibit(source),
          interpolation_exhibit(source), refinement_exhibit(source),      modulus_appendix(source),
          toughness_appendix(source),    family_modulus_appendix(source), family_toughness_appendix(source),
          growth_appendix(source)};
}

std::string render_paper(const PaperSource& source, const std::vector<Exhibit>& exhibits) {
  return render_page(
      {.title = source.run_id + " – figures and tables – nacre",
       .eyebrow = "nacre, figures and tables of the thesis from a run of one's own",
       .heading = source.run_id,
       .content =
           standing_sentences(source.run) +
           paragraph("Numbers and order are those of the thesis; what this run does not hold is said in its place. "
                     "Rows and lines marked <em>thesis</em> are its printed figures, from real specimens: a run "
                     "against the virtual laboratory is like them in kind.",
                     "quiet") +
           paragraph("Pictures of patterns show one unit of 20 × 20 pixels: " + phase_legend() + ".", "quiet")},
      exhibits);
}

void write_paper(const std::filesystem::path& folder, const PaperSource& source) {
  std::filesystem::create_directories(folder);
  const std::vector<Exhibit> exhibits = exhibits_of(source);
  for (const Exhibit& exhibit : exhibits) {
    for (const ExhibitFigure& each : exhibit.figures)
      write_file_atomically(folder / (each.name + ".svg"), standalone(each.svg));
    for (const ExhibitTable& table : exhibit.tables)
      write_file_atomically(folder / (table.name + ".csv"), csv_of(table));
  }
  write_file_atomically(folder / "index.html", render_paper(source, exhibits));
}

}  // namespace nacre::report
