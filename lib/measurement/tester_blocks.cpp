#include "measurement/tester_blocks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/csv.hpp"
#include "measurement/cell_units.hpp"
#include "measurement/heading_lines.hpp"
#include "measurement/set_files.hpp"
#include "measurement/tester_delimiter.hpp"
#include "measurement/tester_header.hpp"
#include "measurement/tester_numbers.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

class TableFinder {
 public:
  TableFinder(const std::vector<std::string_view>& lines, std::string file, const ColumnChoice& choice)
      : lines_(lines), file_(std::move(file)), choice_(choice) {}

  tl::expected<ExportTables, ImportFault> find() {
    const char certain = delimiter_of(lines_);
    has_numbers_ = certain != '\0';
    for (const char delimiter : {'\t', ';', ',', '|'}) {
      if (certain != '\0' && delimiter != certain) continue;
      tables_ = {.delimiter = delimiter, .blocks = {}};
      read();
      if (fault_) return tl::unexpected(*fault_);
      if (!tables_.blocks.empty()) return std::move(tables_);
    }
    if (certain != '\0' && read_bare_table()) {
      if (fault_) return tl::unexpected(*fault_);
      return std::move(tables_);
    }
    for (const char blanks : {kGaps, kBlanks}) {
      if (!read_between_blanks(blanks)) continue;
      if (fault_) return tl::unexpected(*fault_);
      return std::move(tables_);
    }
    return tl::unexpected(no_heading());
  }

 private:
  void split(std::size_t index) { split_cells(lines_[index], tables_.delimiter, cells_); }

  bool is_named(const ColumnName& column, Quantity quantity) const {
    const std::string& wanted = choice_.of(quantity);
    return wanted.empty() ? column.quantity == quantity : match(column.heading, column.name, wanted) > 0;
  }
  bool holds(const std::vector<ColumnName>& columns, Quantity quantity) const {
    return std::any_of(columns.begin(), columns.end(), [&](const auto& each) { return is_named(each, quantity); });
  }
  /// The columns without which there is no curve: a strain or a stress only where the sheet names it.
  Quantity abscissa() const { return choice_.strain.empty() ? Quantity::extension : Quantity::strain; }
  Quantity ordinate() const { return choice_.stress.empty() ? Quantity::force : Quantity::stress; }

  /// The names in a line of words; empty where it cannot be a heading.
  std::vector<ColumnName> names_in(const Cells& cells) const {
    constexpr std::size_t kMostColumns = 256;
    std::vector<ColumnName> names;
    if (cells.size() < 2 || cells.size() > kMostColumns) return names;
    for (const std::string_view cell : cells)
      names.push_back(has_letter(cell) && !is_number(cell) ? recognise_column(cell)
                                                           : ColumnName{.heading = std::string(cell)});
    return names;
  }
  bool is_heading(const std::vector<ColumnName>& names) const {
    return holds(names, abscissa()) && holds(names, ordinate());
  }

  /// The heading that a line of words and the next give together; empty where one of them is the heading and the other
  /// does not tell columns of one quantity apart (labels of specimens, names of channels).
  std::vector<std::string> names_over_two_lines(std::size_t index) const {
    if (index + 2 >= lines_.size() || !has_letter(lines_[index + 1])) return {};
    Cells upper, lower;
    split_cells(lines_[index], tables_.delimiter, upper);
    split_cells(lines_[index + 1], tables_.delimiter, lower);
    for (const Cells* cells : {&upper, &lower}) {
      if (std::any_of(cells->begin(), cells->end(), is_measured) || is_unit_row(*cells)) return {};
    }
    std::vector<std::string> joined = joined_headings(upper, lower);
    if (joined.empty() || !is_heading(names_in(Cells(joined.begin(), joined.end())))) return {};
    const bool is_upper = is_heading(names_in(upper)), is_lower = is_heading(names_in(lower));
    const auto has_digit = [&](std::size_t line) {
      return lines_[line].find_first_of("0123456789:") != std::string_view::npos;
    };
    const bool is_one = is_upper != is_lower ? tells_roles(is_upper ? lower : upper)
                                             : !is_upper && filled(upper) > 1 && filled(lower) > 1 &&
                                                   !has_digit(index) && !has_digit(index + 1);
    return is_one && are_numbers_next(index + 2) ? joined : std::vector<std::string>{};
  }

  /// Whether a row of units or of numbers follows.
  bool are_numbers_next(std::size_t index) const {
    while (index < lines_.size() && is_blank(lines_[index])) ++index;
    if (index >= lines_.size()) return false;
    Cells below;
    split_cells(lines_[index], tables_.delimiter, below);
    return is_unit_row(below) || std::count_if(below.begin(), below.end(), is_measured) > 1;
  }

  void read() {
    before_.clear();
    for (std::size_t i = 0; i < lines_.size() && !fault_;) {
      if (is_blank(lines_[i])) {
        ++i;
        continue;
      }
      if (tables_.blocks.empty() && i >= kMostHeaderLines) return;
      if (!has_letter(lines_[i])) {
        before_.push_back(i++);
        continue;
      }
      if (const std::vector<std::string> joined = names_over_two_lines(i); !joined.empty()) {
        i = read_block(i, i + 2, joined);
        continue;
      }
      split(i);
      std::vector<ColumnName> names = names_in(cells_);
      note_resemblance(i, names);
      if (!is_heading(names)) {
        before_.push_back(i++);
        continue;
      }
      i = read_block(i, i + 1, std::vector<std::string>(cells_.begin(), cells_.end()));
    }
  }

  /// Title, labels and units from the lines above; returns the units by column.
  std::vector<std::string> look_above(TableBlock& block, std::size_t columns) {
    std::vector<std::string> units;
    Cells above;
    for (std::size_t back = 1; back <= 2 && back <= before_.size(); ++back) {
      const std::size_t index = before_[before_.size() - back];
      if (block.heading - index > back + 1) break;
      split_cells(lines_[index], tables_.delimiter, above);
      if (units.empty() && above.size() + 1 >= columns && filled(above) > 1 && is_unit_row(above)) {
        units.assign(above.begin(), above.end());
        block.unit_line = index;
      } else if (block.labels.empty() && above.size() > 1 && filled(above) >= 1) {
        block.labels.assign(above.begin(), above.end());
      }
    }
    for (auto index = before_.rbegin(); index != before_.rend() && block.title.empty(); ++index) {
      split_cells(lines_[*index], tables_.delimiter, above);
      if (is_unit_row(above) && filled(above) > 1) continue;
      for (const std::string_view cell : above) {
        if (!cell.empty()) block.title += (block.title.empty() ? "" : " ") + std::string(cell);
      }
    }
    return units;
  }

  /// Units from the lines below the heading; returns the line after them.
  std::size_t look_below(TableBlock& block, std::size_t next, std::vector<std::string>& units) {
    constexpr int kMostLines = 3;  // of units, numbers of channels, names of signals
    Cells below;
    for (int seen = 0; next < lines_.size() && seen < kMostLines; ++next) {
      if (is_blank(lines_[next])) continue;
      split_cells(lines_[next], tables_.delimiter, below);
      const auto numbers = std::count_if(below.begin(), below.end(), is_measured);
      if (numbers > 0 && !is_unit_row(below)) break;
      if (!is_unit_row(below)) {
        if (seen > 0 || below.size() < 2 || filled(below) < 2 || is_heading(names_in(below)) || !leads_to_units(next))
          break;
      } else if (units.empty()) {
        units.assign(below.begin(), below.end());
        block.unit_line = next;
      }
      ++seen;
    }
    return next;
  }

  /// Whether the next line but one of words is a row of units.
  bool leads_to_units(std::size_t index) const {
    Cells below;
    for (++index; index < lines_.size(); ++index) {
      if (is_blank(lines_[index])) continue;
      split_cells(lines_[index], tables_.delimiter, below);
      return is_unit_row(below);
    }
    return false;
  }

  std::size_t read_block(std::size_t heading, std::size_t below, const std::vector<std::string>& names) {
    TableBlock block{.heading = heading,
                     .unit_line = heading,
                     .title = {},
                     .columns = {},
                     .labels = {},
                     .lines = {},
                     .begins = {},
                     .cells = {},
                     .breaks = {}};
    std::vector<std::string> units = look_above(block, names.size());
    const std::size_t next = look_below(block, below, units);
    for (std::size_t i = 0; i < names.size(); ++i)
      block.columns.push_back(has_letter(names[i]) || !names[i].empty()
                                  ? recognise_column(names[i], i < units.size() ? units[i] : std::string_view{})
                                  : ColumnName{});
    before_.clear();
    return read_rows(std::move(block), next);
  }

  /// How many of the two needed columns hold a number.
  int numbers_in(const TableBlock& block, const Cells& cells, const std::vector<std::size_t>& abscissae,
                 const std::vector<std::size_t>& ordinates) const {
    const auto is_value = [&](std::string_view cell) {
      return is_number(cell) || ((block.lines.empty() || block.has_cell_units) && number_with_unit(cell));
    };
    const auto any = [&](const std::vector<std::size_t>& places) {
      return std::any_of(places.begin(), places.end(),
                         [&](std::size_t place) { return place < cells.size() && is_value(cells[place]); });
    };
    return static_cast<int>(any(abscissae)) + static_cast<int>(any(ordinates));
  }

  std::vector<std::size_t> places_of(const std::vector<ColumnName>& columns, Quantity quantity) const {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (is_named(columns[i], quantity)) places.push_back(i);
    }
    return places;
  }

  static std::string words_in(const Cells& cells) {
    std::string words;
    for (const std::string_view cell : cells) {
      if (!cell.empty()) words += (words.empty() ? "" : " ") + std::string(cell);
    }
    return words;
  }

  /// A line that names a specimen, `Probe;2`, is a title, too.
  static bool is_title(const Cells& cells) {
    if (filled(cells) == 1) return true;
    const auto first = std::find_if(cells.begin(), cells.end(), [](auto cell) { return !cell.empty(); });
    return filled(cells) == 2 && first != cells.end() && recognise_column(*first).is_specimen;
  }

  /// The rows of numbers up to the next heading or the end. A row of several words ends them; in the middle of the
  /// numbers it is damage, but not below an empty line (a table of results).
  std::size_t read_rows(TableBlock block, std::size_t next) {
    const auto abscissae = places_of(block.columns, abscissa()), ordinates = places_of(block.columns, ordinate());
    std::optional<std::size_t> doubtful;
    bool after_gap = false, is_over = false;
    std::string title;
    for (; next < lines_.size(); ++next) {
      if (is_blank(lines_[next])) {
        after_gap = true;
        continue;
      }
      split(next);
      const int numbers = numbers_in(block, cells_, abscissae, ordinates);
      if (numbers < 2 && has_letter(lines_[next])) {
        const std::vector<ColumnName> names = names_in(cells_);
        if (is_heading(names) || !names_over_two_lines(next).empty()) break;
      }
      if (is_over) {
        block.ignored_rows += numbers == 2;
        if (numbers < 2) before_.push_back(next);
        continue;
      }
      if (numbers == 2 && is_statistics(block)) {
        ++block.statistics;
        continue;
      }
      const bool directly_below = !after_gap && title.empty();
      if (numbers == 2 || (numbers == 1 && directly_below && !block.lines.empty())) {
        if (doubtful && directly_below) return refuse_damage(block, *doubtful);
        if ((after_gap || !title.empty()) && !block.lines.empty()) block.breaks.push_back({block.rows(), title});
        after_gap = false;
        title.clear();
        if (!take_row(block, next)) return lines_.size();
      } else if (is_title(cells_) && has_letter(lines_[next]) &&
                 (after_gap || block.lines.empty() || !is_cut_off(block))) {
        before_.push_back(next);
        title += (title.empty() ? "" : " ") + words_in(cells_);
      } else if (after_gap && !block.lines.empty()) {
        before_.push_back(next);
        is_over = true;
      } else {
        if (!doubtful) doubtful = next;
        before_.push_back(next);
        if (numbers == 1) return refuse_damage(block, *doubtful);
      }
    }
    if (block.lines.empty() && doubtful) return refuse_damage(block, *doubtful);
    close(std::move(block));
    return next;
  }

  /// Whether a row sums up others: its first cell is such a word, where rows of the record have none.
  bool is_statistics(const TableBlock& block) const {
    const auto first = std::find_if(cells_.begin(), cells_.end(), [](auto cell) { return !cell.empty(); });
    if (first == cells_.end() || !has_letter(*first) || is_measured(*first)) return false;
    std::string words = plain_words(*first);
    if (words.ends_with(':')) words.pop_back();
    if (!is_statistic(words)) return false;
    const auto column = static_cast<std::size_t>(first - cells_.begin());
    return block.lines.size() < 2 || block.cell(0, column) != *first;
  }

  /// A line with one cell among rows of many is a title, unless it is a row that was cut.
  bool is_cut_off(const TableBlock& block) const { return is_number(cells_[0]) || block.columns.size() < 2; }

  bool take_row(TableBlock& block, std::size_t index) {
    if (block.rows() >= kMostCurveRows) {
      reject(index + 1, "", fmt::format("more than {} rows, expected at most that many", kMostCurveRows));
      return false;
    }
    if (block.lines.empty()) block.has_cell_units = std::any_of(cells_.begin(), cells_.end(), number_with_unit);
    block.lines.push_back(index);
    block.begins.push_back(block.cells.size());
    block.cells.insert(block.cells.end(), cells_.begin(), cells_.end());
    return true;
  }

  void close(TableBlock block) {
    block.begins.push_back(block.cells.size());
    if (block.has_cell_units) take_units_out(block);
    tables_.blocks.push_back(std::move(block));
  }

  std::size_t refuse_damage(const TableBlock& block, std::size_t index) {
    split(index);
    for (const Quantity quantity : {abscissa(), ordinate()}) {
      const std::size_t column = places_of(block.columns, quantity).front();
      const std::string_view end = block.lines.empty() ? "" : "; is the file cut off or edited?";
      if (column >= cells_.size()) {
        reject(index + 1, block.columns[column].heading,
               fmt::format("the row has {} cells, expected {}{}", cells_.size(), block.columns.size(), end));
      } else if (!is_number(cells_[column])) {
        reject(index + 1, block.columns[column].heading,
               fmt::format("`{}` is not a number, expected {}{}", cells_[column], to_string(quantity), end));
      }
    }
    return lines_.size();
  }

  void reject(std::size_t line, std::string column, std::string reason) {
    if (!fault_) fault_ = ImportFault{file_, static_cast<int>(line), std::move(column), std::move(reason)};
  }

  /// Two or three columns of numbers and nothing else: (time,) extension, force in s, mm, N.
  bool read_bare_table() {
    if (!(choice_ ==
          ColumnChoice{.extension = {}, .force = {}, .time = {}, .strain = {}, .stress = {}, .unit = choice_.unit}))
      return false;
    tables_ = {.delimiter = delimiter_of(lines_), .blocks = {}};
    std::size_t first = 0;
    while (first < lines_.size() && is_blank(lines_[first])) ++first;
    if (first + kFewestCurveRows > lines_.size()) return false;
    split(first);
    if (cells_.size() < 2 || cells_.size() > 3 || !std::all_of(cells_.begin(), cells_.end(), is_number)) return false;
    TableBlock block{.heading = first,
                     .unit_line = first,
                     .is_bare = true,
                     .title = {},
                     .columns = {},
                     .labels = {},
                     .lines = {},
                     .begins = {},
                     .cells = {},
                     .breaks = {}};
    const bool has_time = cells_.size() == 3;
    for (const char* name : {"time s", "extension mm", "force N"}) {
      if (has_time || std::string_view(name) != "time s") block.columns.push_back(recognise_column(name));
    }
    read_rows(std::move(block), first);
    return true;
  }

  /// Columns that runs of blanks separate, or single ones, where no delimiter gives a table.
  bool read_between_blanks(char blanks) {
    if (score_of(lines_, blanks) <= 0.0) return false;
    const ExportTables before = std::exchange(tables_, {.delimiter = blanks, .blocks = {}});
    has_numbers_ = true;
    read();
    if (!tables_.blocks.empty() || fault_) return true;
    tables_.delimiter = before.delimiter;
    return false;
  }

  void note_resemblance(std::size_t index, const std::vector<ColumnName>& names) {
    if (resemblance_ || names.size() < 2 || !has_numbers_) return;
    if (holds(names, abscissa()) == holds(names, ordinate())) return;
    const Quantity missing = holds(names, ordinate()) ? abscissa() : ordinate();
    const std::string& asked = choice_.of(missing);
    std::vector<std::string> headings;
    for (const ColumnName& name : names) headings.push_back(name.heading);
    resemblance_ = ImportFault{
        file_, static_cast<int>(index) + 1, std::string(to_string(missing)),
        asked.empty()
            ? fmt::format("no column of {} among `{}`, expected a name such as {}, or {}_column in the sheet",
                          to_string(missing), fmt::join(headings, "`, `"), expected_names(missing), to_string(missing))
            : fmt::format("no column `{}` among `{}`", asked, fmt::join(headings, "`, `"))};
  }

  /// The first line that could be a heading, above the first row of numbers.
  std::string first_words() const {
    Cells cells, words;
    for (std::size_t i = 0; i < std::min(lines_.size(), kMostHeaderLines); ++i) {
      split_cells(lines_[i], tables_.delimiter, cells);
      if (cells.size() > 1 && std::all_of(cells.begin(), cells.end(), is_number)) break;
      if (filled(cells) > 1 && has_letter(lines_[i])) words = cells;
    }
    return words.empty() ? "" : fmt::format("`{}`", fmt::join(words, "`, `"));
  }

  ImportFault no_heading() const {
    if (resemblance_) return *resemblance_;
    if (std::all_of(lines_.begin(), lines_.end(), [](auto line) { return trimmed(line).empty(); }))
      return {file_, 0, "", "is empty, expected a table of time, extension and force"};
    const std::string words = first_words();
    std::vector<std::string> asked;
    for (const Quantity quantity : {abscissa(), ordinate()}) {
      if (!choice_.of(quantity).empty()) asked.push_back(choice_.of(quantity));
    }
    if (!asked.empty())
      return {file_, 0, "",
              fmt::format("no heading with `{}`{}, expected the columns that the sheet names", fmt::join(asked, "`, `"),
                          words.empty() ? "" : ", but " + words)};
    return {file_, 0, "",
            fmt::format(
                "no heading with extension and force{}, expected names such as {}, and {}, separated by "
                "commas, semicolons, tabs, bars or blanks, or extension_column and force_column in the sheet; stress "
                "and strain are read where the sheet has strain_column and stress_column",
                words.empty() ? "" : ", but " + words, expected_names(Quantity::extension),
                expected_names(Quantity::force))};
  }

  const std::vector<std::string_view>& lines_;
  std::string file_;
  ColumnChoice choice_;
  ExportTables tables_;
  Cells cells_;
  std::vector<std::size_t> before_;  ///< lines of words since the last table
  bool has_numbers_ = false;
  std::optional<ImportFault> resemblance_, fault_;
};

}  // namespace

tl::expected<ExportTables, ImportFault> tables_of(const std::vector<std::string_view>& lines, const std::string& file,
                                                  const ColumnChoice& choice) {
  return TableFinder(lines, file, choice).find();
}

}  // namespace nacre::measurement
