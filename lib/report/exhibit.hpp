#pragma once
// An exhibit: what a page shows of one thing, under one heading. The report of a game, the page of a diagnosis and the
// figures and tables of the thesis are lists of exhibits; render_exhibit() alone turns one into HTML.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nacre::report {

/// A value as a page shows it and as a file keeps it.
struct Cell {
  std::string shown;      ///< HTML
  std::string kept = {};  ///< plain; SI units
};
/// HTML that stands in no file.
Cell shown_cell(std::string html);
Cell text_cell(std::string_view text);
Cell design_cell(std::string_view name);  ///< with a picture of the unit
Cell gpa_cell(const std::optional<double>& pa);
Cell mpa_cell(const std::optional<double>& pa);
Cell share_cell(const std::optional<double>& share);
/// An error over `count` designs, a dash over none (game::error_over).
Cell error_cell(int count, double error);
Cell number_cell(const std::optional<double>& value);

struct TableColumn {
  std::string name;        ///< in the CSV
  std::string heading;     ///< on the page
  std::string hint = {};   ///< what the heading means, shown when the pointer rests on it
  std::string group = {};  ///< heading above neighbouring columns that share it
};

/// Whose row it is; what stands aside is shown, but counts nowhere.
enum class TableRowKind { own, thesis, aside };

struct ExhibitTable {
  std::string name;  ///< of the file, without .csv; empty: no file
  std::vector<TableColumn> columns;
  std::vector<std::vector<Cell>> rows = {};
  std::vector<TableRowKind> kinds = {};  ///< per row
  bool on_page = true;                   ///< false: the data of a figure
  std::string folded = {};               ///< what a person opens it by; empty: it is open
  std::string look =
      {};  ///< CSS classes: "words" for text, "words wrapped" for sentences, "named" for text in the second column
  void add(std::vector<Cell> row, TableRowKind kind = TableRowKind::own);
};

struct ExhibitFigure {
  std::string name;  ///< of the file, without .svg; empty: no file
  std::string svg;
  std::string caption = {};  ///< HTML; with one the figure is a card: picture left, words right
};

/// Where there is nothing to show, the notes say what is missing. In this order on the page:
struct Exhibit {
  std::string id;                       ///< figure-3-2
  std::string heading;                  ///< plain
  std::vector<std::string> notes = {};  ///< HTML, a paragraph each
  std::vector<std::string> list = {};   ///< HTML, numbered
  std::vector<std::string> warnings = {};
  std::vector<ExhibitFigure> figures = {};
  std::vector<ExhibitTable> tables = {};
  std::vector<Exhibit> parts = {};           ///< under smaller headings, without id
  std::vector<std::string> fine_print = {};  ///< HTML: how it was computed
};

/// Drawings without captions, behind those that are there.
void add_figures(Exhibit& exhibit, std::vector<std::string> svgs);

/// A note that stands for what is still to come.
std::string awaited(std::string_view what);

/// A paragraph of safe HTML.
std::string paragraph(std::string_view html, std::string_view classes = "");

/// A table as HTML, without the box that scrolls.
std::string html_of(const ExhibitTable& table);

/// A table as CSV; the last column says whose a row is: run or thesis.
std::string csv_of(const ExhibitTable& table);

/// The exhibit as a section of a page.
std::string render_exhibit(const Exhibit& exhibit);

/// Links to the exhibits, each called by its heading up to a colon.
std::string render_contents(const std::vector<Exhibit>& exhibits);

}  // namespace nacre::report
