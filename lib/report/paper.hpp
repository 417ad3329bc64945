#pragma once
// The figures and tables of the thesis from a run of one's own (`nacre report`): one page, and every figure as SVG and
// CSV, every table as CSV.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "families/grouping.hpp"
#include "game/thesis_tables.hpp"
#include "measurement/summary.hpp"
#include "store/run_record.hpp"

namespace nacre::report {

/// One search for a gamut: what it simulated, in its order.
struct SearchPath {
  int round = 0, branch = 0;
  std::vector<optimize::Performance> samples;
};

/// A point of a subfamily's map (`nacre families`).
struct MapPoint {
  pattern::Pattern pattern;
  std::string source;                          ///< seed, sampled, interpolated
  double x = 0.0, y = 0.0;                     ///< of the map of all
  std::optional<double> x_sampled, y_sampled;  ///< of the map before interpolation
  std::optional<optimize::Performance> performance;
};

struct SubfamilyMap {
  std::string family, seed;
  std::vector<MapPoint> points;
};

/// All that the exhibits are made of. What a run does not hold is empty.
struct PaperSource {
  std::string run_id;
  store::RunRecord run;
  game::ThesisTables thesis;
  std::vector<measurement::Replicates> base_materials;               ///< that round 0 was fitted to
  std::vector<SearchPath> searches;                                  ///< by round and branch
  std::map<int, std::map<std::string, game::DesignValues>> answers;  ///< round of the model -> design -> what it says
  std::vector<families::SeedFamily> groups;
  std::string groups_from;         ///< where they come from, in words
  std::vector<SubfamilyMap> maps;  ///< by family and seed
};

/// Reads a run's folder; `thesis_folder` is data/thesis, empty when it was not found. Throws InputError.
PaperSource read_paper_source(const std::filesystem::path& run_dir, const std::string& run_id,
                              const std::filesystem::path& thesis_folder);

/// A value as the page shows it and as a table keeps it.
struct Cell {
  std::string shown;  ///< HTML
  std::string kept;   ///< plain; SI units
};
Cell text_cell(std::string_view text);
Cell design_cell(std::string_view name);  ///< with a picture of the unit
Cell gpa_cell(const std::optional<double>& pa);
Cell mpa_cell(const std::optional<double>& pa);
Cell share_cell(const std::optional<double>& share);
/// An error over `count` designs, a dash over none (game::error_over).
Cell error_cell(int count, double error);
Cell number_cell(const std::optional<double>& value);

/// Relative error of a prediction, where both are known.
std::optional<double> error_of(const std::optional<double>& simulated, const std::optional<double>& measured);

struct Column {
  std::string name;     ///< in the CSV
  std::string heading;  ///< on the page
};

struct PaperTable {
  std::string name;  ///< of the file, without .csv
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
  std::vector<bool> is_thesis;  ///< per row: the thesis' figures; shorter than rows: the others are the run's
  bool on_page = true;          ///< false: the data of a figure
  void add(std::vector<Cell> row, bool thesis = false);
};

struct PaperFigure {
  std::string name;  ///< of the file, without .svg
  std::string svg;
};

/// A figure or table of the thesis, made of the run. Where there is nothing to show, its notes say what is missing.
struct Exhibit {
  std::string id;                  ///< figure-3-2
  std::string heading;             ///< plain
  std::vector<std::string> notes;  ///< HTML
  std::vector<PaperFigure> figures;
  std::vector<PaperTable> tables;
};

std::vector<Exhibit> exhibits_of(const PaperSource& source);

// Its parts, in the order of the thesis.
Exhibit gamut_exhibit(const PaperSource& source);              // Figure 3-2
Exhibit hypervolume_exhibit(const PaperSource& source);        // 3-3
Exhibit best_exhibit(const PaperSource& source);               // 3-4, Table 3.3
Exhibit base_material_exhibit(const PaperSource& source);      // Table 3.4
Exhibit error_exhibit(const PaperSource& source);              // 3-7, Table 3.5
Exhibit search_exhibit(const PaperSource& source);             // 3-9
Exhibit family_exhibit(const PaperSource& source);             // 3-12
Exhibit family_curve_exhibit(const PaperSource& source);       // 3-13
Exhibit seed_error_exhibit(const PaperSource& source);         // 3-14, Table 3.6
Exhibit family_gamut_exhibit(const PaperSource& source);       // 3-15
Exhibit validation_exhibit(const PaperSource& source);         // Table 3.7
Exhibit map_exhibit(const PaperSource& source);                // 3-16
Exhibit interpolation_exhibit(const PaperSource& source);      // 3-17
Exhibit refinement_exhibit(const PaperSource& source);         // 3-18
Exhibit modulus_appendix(const PaperSource& source);           // Table A.3
Exhibit toughness_appendix(const PaperSource& source);         // A.4
Exhibit family_modulus_appendix(const PaperSource& source);    // A.5
Exhibit family_toughness_appendix(const PaperSource& source);  // A.6
Exhibit growth_appendix(const PaperSource& source);            // A.7

/// The page: self-contained, no script, nothing from outside; light and dark, and light on paper.
std::string render_paper(const PaperSource& source, const std::vector<Exhibit>& exhibits);

/// Writes FOLDER/index.html and every figure and table beside it. Throws InputError.
void write_paper(const std::filesystem::path& folder, const PaperSource& source);

}  // namespace nacre::report
