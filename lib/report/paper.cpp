// The page of the exhibits and their files.

#include "report/paper.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "game/family_errors.hpp"
#include "report/report_figures.hpp"
#include "report/report_sections.hpp"
#include "report/report_style.hpp"
#include "report/report_text.hpp"
#include "report/svg.hpp"

namespace nacre::report {
namespace {

constexpr int kPictureInTable = 34;  // px

std::string kept_number(const std::optional<double>& value) { return value ? fmt::format("{:.6g}", *value) : ""; }

std::string csv_of(const PaperTable& table) {
  std::string text;
  for (const Column& column : table.columns) text += (text.empty() ? "" : ",") + csv_cell(column.name);
  text += ",whose\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    for (const Cell& cell : table.rows[i]) text += csv_cell(cell.kept) + ",";
    text += i < table.is_thesis.size() && table.is_thesis[i] ? "thesis\n" : "run\n";
  }
  return text;
}

std::string html_of(const PaperTable& table) {
  std::string header = "<tr>", rows;
  for (const Column& column : table.columns)
    header += fmt::format("<th scope=\"col\">{}</th>", escaped(column.heading));
  bool before = false;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const bool is_thesis = i < table.is_thesis.size() && table.is_thesis[i];
    std::vector<std::string> cells;
    for (const Cell& cell : table.rows[i]) cells.push_back(cell.shown);
    rows += table_row(cells, !is_thesis ? "" : before || i == 0 ? "reference" : "reference first-reference");
    before = is_thesis;
  }
  return report::table(header + "</tr>\n", rows);
}

std::string files_of(const Exhibit& exhibit) {
  std::string links;
  const auto add = [&](const std::string& file) {
    links += fmt::format("{}<a href=\"{}\">{}</a>", links.empty() ? "" : ", ", file, file);
  };
  for (const PaperFigure& figure : exhibit.figures) add(figure.name + ".svg");
  for (const PaperTable& table : exhibit.tables) add(table.name + ".csv");
  return links.empty() ? "" : paragraph("Files beside this page: " + links + ".", "quiet files");
}

std::string section_of(const Exhibit& exhibit) {
  std::string content;
  for (const std::string& note : exhibit.notes) content += paragraph(note);
  if (!exhibit.figures.empty()) {
    content += "<div class=\"figures\">\n";
    for (const PaperFigure& figure : exhibit.figures) content += figure.svg;
    content += "</div>\n";
  }
  for (const PaperTable& table : exhibit.tables)
    if (table.on_page && !table.rows.empty()) content += html_of(table);
  return section(exhibit.id, escaped(exhibit.heading), content + files_of(exhibit));
}

std::string contents_of(const std::vector<Exhibit>& exhibits) {
  std::string links = "<nav>";
  for (const Exhibit& exhibit : exhibits) {
    const std::string word = exhibit.heading.substr(0, exhibit.heading.find(':'));
    links += fmt::format("<a href=\"#{}\">{}</a>", exhibit.id, escaped(word));
  }
  return links + "</nav>\n";
}

}  // namespace

Cell text_cell(std::string_view text) { return {escaped(text), std::string(text)}; }

Cell design_cell(std::string_view name) {
  const auto design = pattern::design_from_name(name);
  const std::string picture = design ? design_picture(*design, kPictureInTable) : "";
  return {fmt::format("<span class=\"design\">{}{}</span>", picture, design_name(name)), std::string(name)};
}

Cell gpa_cell(const std::optional<double>& pa) { return {pa ? gpa(*pa) : "–", kept_number(pa)}; }
Cell mpa_cell(const std::optional<double>& pa) { return {pa ? mpa(*pa) : "–", kept_number(pa)}; }
Cell share_cell(const std::optional<double>& share) { return {percent_or_dash(share), kept_number(share)}; }
Cell error_cell(int count, double error) { return share_cell(game::error_over(count, error)); }
Cell number_cell(const std::optional<double>& value) { return {value ? figure(*value) : "–", kept_number(value)}; }

std::optional<double> error_of(const std::optional<double>& simulated, const std::optional<double>& measured) {
  return simulated && measured ? std::optional(std::abs(*simulated - *measured) / *measured) : std::nullopt;
}

void PaperTable::add(std::vector<Cell> row, bool thesis) {
  is_thesis.resize(rows.size());
  rows.push_back(std::move(row));
  is_thesis.push_back(thesis);
}

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
  constexpr std::string_view kExtraStyle =
      ".design { display: inline-flex; align-items: center; gap: 8px; } figure { margin: 0; max-width: 220px; "
      "font-size: 13px; } "
      "figcaption { color: var(--quiet); } td { font-size: 13px; } td:first-child { white-space: nowrap; } @media "
      "print { .files { display: none; } }";
  std::string page = page_begin(fmt::format("{} – figures and tables – nacre", escaped(source.run_id)), kExtraStyle);
  page += fmt::format(
      "<header>\n<p class=\"eyebrow\">nacre, figures and tables of the thesis from a run of one's "
      "own</p>\n<h1>{}</h1>\n",
      escaped(source.run_id));
  page += standing_sentences(source.run);
  page += paragraph(
      "Numbers and order are those of the thesis; what this run does not hold is said in its place. Rows and lines "
      "marked "
      "<em>thesis</em> are its printed figures, from real specimens: a run against the virtual laboratory is like them "
      "in kind.",
      "quiet");
  page += contents_of(exhibits) + "</header>\n";
  for (const Exhibit& exhibit : exhibits) page += section_of(exhibit);
  return page + "</main>\n</body>\n</html>\n";
}

void write_paper(const std::filesystem::path& folder, const PaperSource& source) {
  std::filesystem::create_directories(folder);
  const std::vector<Exhibit> exhibits = exhibits_of(source);
  for (const Exhibit& exhibit : exhibits) {
    for (const PaperFigure& figure : exhibit.figures)
      write_file_atomically(folder / (figure.name + ".svg"), standalone(figure.svg));
    for (const PaperTable& table : exhibit.tables) write_file_atomically(folder / (table.name + ".csv"), csv_of(table));
  }
  write_file_atomically(folder / "index.html", render_paper(source, exhibits));
}

}  // namespace nacre::report
