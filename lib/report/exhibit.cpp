#include "report/exhibit.hpp"

#include <utility>

#include <fmt/format.h>

#include "base/csv.hpp"
#include "game/family_errors.hpp"
#include "pattern/design.hpp"
#include "report/design_picture.hpp"
#include "report/report_text.hpp"
#include "report/svg.hpp"

namespace nacre::report {
namespace {

constexpr int kPictureInTable = 34;  // px

std::string kept_number(const std::optional<double>& value) { return value ? fmt::format("{:.6g}", *value) : ""; }

TableRowKind kind_of(const ExhibitTable& table, std::size_t row) {
  return row < table.kinds.size() ? table.kinds[row] : TableRowKind::own;
}

std::string heading_cell(std::string_view attributes, const std::string& text, const std::string& hint) {
  const std::string title = hint.empty() ? "" : fmt::format(" title=\"{}\"", escaped(hint));
  return fmt::format("<th {}{}>{}</th>", attributes, title, escaped(text));
}

/// One row of headings, or two where columns are grouped.
std::string table_head(const ExhibitTable& table) {
  bool is_grouped = false;
  for (const TableColumn& column : table.columns) is_grouped = is_grouped || !column.group.empty();
  std::string first, second;
  for (std::size_t i = 0; i < table.columns.size();) {
    const TableColumn& column = table.columns[i];
    if (column.group.empty()) {
      first += heading_cell(is_grouped ? "scope=\"col\" rowspan=\"2\"" : "scope=\"col\"", column.heading, column.hint);
      ++i;
      continue;
    }
    std::size_t end = i;
    for (; end < table.columns.size() && table.columns[end].group == column.group; ++end)
      second += heading_cell("scope=\"col\"", table.columns[end].heading, table.columns[end].hint);
    first += heading_cell(fmt::format("scope=\"colgroup\" colspan=\"{}\" class=\"group\"", end - i), column.group, "");
    i = end;
  }
  return fmt::format("<tr>{}</tr>\n", first) + (is_grouped ? fmt::format("<tr>{}</tr>\n", second) : "");
}

std::string_view row_classes(const ExhibitTable& table, std::size_t row) {
  if (kind_of(table, row) == TableRowKind::aside) return "aside";
  if (kind_of(table, row) == TableRowKind::own) return "";
  return row > 0 && kind_of(table, row - 1) != TableRowKind::thesis ? "reference first-reference" : "reference";
}

std::string files_of(const Exhibit& exhibit) {
  std::string links;
  const auto add = [&](const std::string& name, std::string_view extension) {
    if (name.empty()) return;
    links += fmt::format("{0}<a href=\"{1}{2}\">{1}{2}</a>", links.empty() ? "" : ", ", name, extension);
  };
  for (const ExhibitFigure& each : exhibit.figures) add(each.name, ".svg");
  for (const ExhibitTable& table : exhibit.tables) add(table.name, ".csv");
  return links.empty() ? "" : paragraph("Files: " + links + ".", "quiet files");
}

std::string figures_of(const Exhibit& exhibit) {
  std::string plots, cards;
  for (const ExhibitFigure& each : exhibit.figures) {
    if (each.caption.empty())
      plots += each.svg;
    else
      cards += fmt::format("<div class=\"card\">{}<div>{}</div></div>\n", each.svg, each.caption);
  }
  if (!plots.empty()) plots = "<div class=\"figures\">\n" + plots + "</div>\n";
  if (!cards.empty()) cards = "<div class=\"cards\">\n" + cards + "</div>\n";
  return plots + cards;
}

std::string content_of(const Exhibit& exhibit) {
  std::string content;
  for (const std::string& note : exhibit.notes) content += paragraph(note);
  for (std::size_t i = 0; i < exhibit.list.size(); ++i)
    content += fmt::format("{}<li>{}</li>\n{}", i == 0 ? "<ol>\n" : "", exhibit.list[i],
                           i + 1 == exhibit.list.size() ? "</ol>\n" : "");
  for (const std::string& warning : exhibit.warnings) content += paragraph(warning, "warning");
  content += figures_of(exhibit);
  for (const ExhibitTable& table : exhibit.tables) {
    if (!table.on_page || table.rows.empty()) continue;
    const std::string shown = "<div class=\"wide\">" + html_of(table) + "</div>\n";
    content += table.folded.empty()
                   ? shown
                   : fmt::format("<details><summary>{}</summary>\n{}</details>\n", escaped(table.folded), shown);
  }
  for (const Exhibit& part : exhibit.parts)
    content += fmt::format("<h3>{}</h3>\n", escaped(part.heading)) + content_of(part);
  for (const std::string& line : exhibit.fine_print) content += paragraph(line, "quiet");
  return content + files_of(exhibit);
}

}  // namespace

Cell shown_cell(std::string html) { return {std::move(html), ""}; }
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

void ExhibitTable::add(std::vector<Cell> row, TableRowKind kind) {
  rows.push_back(std::move(row));
  kinds.resize(rows.size() - 1);
  kinds.push_back(kind);
}

void add_figures(Exhibit& exhibit, std::vector<std::string> svgs) {
  for (std::string& svg : svgs) exhibit.figures.push_back({"", std::move(svg)});
}

std::string awaited(std::string_view what) {
  return fmt::format("<em class=\"awaited\">Still awaited: {}.</em>", what);
}

std::string paragraph(std::string_view html, std::string_view classes) {
  return classes.empty() ? fmt::format("<p>{}</p>\n", html) : fmt::format("<p class=\"{}\">{}</p>\n", classes, html);
}

std::string html_of(const ExhibitTable& table) {
  std::string rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::string_view classes = row_classes(table, i);
    rows += classes.empty() ? "<tr>" : fmt::format("<tr class=\"{}\">", classes);
    for (const Cell& cell : table.rows[i]) rows += fmt::format("<td>{}</td>", cell.shown);
    rows += "</tr>\n";
  }
  return fmt::format("<table class=\"{}\">\n<thead>{}</thead>\n<tbody>{}</tbody>\n</table>", table.look,
                     table_head(table), rows);
}

std::string csv_of(const ExhibitTable& table) {
  std::string text;
  for (const TableColumn& column : table.columns) text += (text.empty() ? "" : ",") + csv_cell(column.name);
  text += ",whose\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    for (const Cell& cell : table.rows[i]) text += csv_cell(cell.kept) + ",";
    text += kind_of(table, i) == TableRowKind::thesis ? "thesis\n" : "run\n";
  }
  return text;
}

std::string render_exhibit(const Exhibit& exhibit) {
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", exhibit.id, escaped(exhibit.heading),
                     content_of(exhibit));
}

std::string render_contents(const std::vector<Exhibit>& exhibits) {
  std::string links;
  for (const Exhibit& exhibit : exhibits)
    links += fmt::format("<a href=\"#{}\">{}</a>", exhibit.id,
                         escaped(exhibit.heading.substr(0, exhibit.heading.find(':'))));
  return "<nav>" + links + "</nav>\n";
}

}  // namespace nacre::report
