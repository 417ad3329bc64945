#include "measurement/sweep_blocks.hpp"

#include <algorithm>
#include <set>
#include <span>
#include <string>

#include "measurement/cell_units.hpp"
#include "measurement/heading_lines.hpp"
#include "measurement/sweep_columns.hpp"
#include "measurement/sweep_header.hpp"
#include "measurement/tester_delimiter.hpp"
#include "measurement/tester_header.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

class SweepFinder {
 public:
  SweepFinder(const std::vector<std::string_view>& lines, char delimiter)
      : lines_(lines), tables_{.delimiter = delimiter, .blocks = {}} {}

  ExportTables find() {
    for (std::size_t i = 0; i < lines_.size();) {
      if (tables_.blocks.empty() && i >= kMostHeaderLines) break;
      const Heading heading = heading_at(i);
      i = heading.names.empty() ? i + 1 : read_block(i, heading);
    }
    return std::move(tables_);
  }

 private:
  struct Heading {
    std::vector<std::string> names;  ///< empty: the line is no heading
    std::size_t end = 0;             ///< index of the line below
  };

  Cells cells_at(std::size_t line) const {
    Cells cells;
    if (line < lines_.size()) split_cells(lines_[line], tables_.delimiter, cells);
    return cells;
  }

  /// The units in a line, by column; empty where it is no row of units.
  std::vector<std::string> units_at(std::size_t line) const {
    const Cells cells = cells_at(line);
    if (filled(cells) < 2 || !is_unit_row(cells, is_unit_of_sweep)) return {};
    return {cells.begin(), cells.end()};
  }

  /// Whether a heading in this line names a frequency (or the lines above tell it) and a storage modulus, or a time and
  /// what relaxes.
  bool names_sweep(std::size_t line, const std::vector<std::string>& names,
                   const std::vector<std::string>& units) const {
    std::set<SweepQuantity> named;
    bool is_pull = false;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const SweepColumn column = recognise_sweep_column(names[i], i < units.size() ? units[i] : "");
      if (column.quantity) named.insert(*column.quantity);
      const auto of_pull = column.name.quantity;
      is_pull = is_pull || of_pull == Quantity::extension || of_pull == Quantity::force || of_pull == Quantity::strain;
    }
    const auto has = [&](SweepQuantity one, SweepQuantity other) {
      return named.contains(one) && named.contains(other);
    };
    if (has(SweepQuantity::time, SweepQuantity::relaxation_modulus) ||
        (has(SweepQuantity::time, SweepQuantity::stress) && !is_pull))
      return true;
    if (!named.contains(SweepQuantity::storage_modulus)) return false;
    if (named.contains(SweepQuantity::frequency)) return true;
    if (!named.contains(SweepQuantity::temperature) && !named.contains(SweepQuantity::amplitude)) return false;
    const auto own = std::span(lines_).subspan(words_, line - words_);
    return has_frequency_above_ || sweep_header_of(own, 1, tables_.delimiter).angular_frequency_per_s.has_value();
  }

  static bool names_frequency(const std::vector<std::string>& names) {
    return std::any_of(names.begin(), names.end(), [](const std::string& name) {
      return recognise_sweep_column(name).quantity == SweepQuantity::frequency;
    });
  }

  /// Whether a line may be one of words: numbers stand below headings.
  static bool are_words(const Cells& cells) {
    constexpr std::size_t kMostColumns = 256;
    return filled(cells) > 1 && cells.size() <= kMostColumns && std::none_of(cells.begin(), cells.end(), is_measured);
  }

  /// The heading in one line, or in two where neither of them is one.
  Heading heading_at(std::size_t line) const {
    if (!has_letter(lines_[line])) return {};
    const Cells upper = cells_at(line), lower = cells_at(line + 1);
    if (!are_words(upper)) return {};
    const std::vector<std::string> names(upper.begin(), upper.end());
    if (names_sweep(line, names, units_at(line + 1))) return {names, line + 1};
    if (!are_words(lower) || names_sweep(line + 1, {lower.begin(), lower.end()}, units_at(line + 2))) return {};
    const std::vector<std::string> joined = joined_headings(upper, lower);
    if (names_sweep(line, joined, units_at(line + 2))) return {joined, line + 2};
    return {};
  }

  std::size_t read_block(std::size_t line, const Heading& heading) {
    TableBlock block;
    block.heading = block.unit_line = line;
    std::size_t next = heading.end;
    while (next < lines_.size() && is_blank(lines_[next])) ++next;
    std::vector<std::string> units = units_at(next);
    if (!units.empty()) {
      block.unit_line = next++;
    } else if (line > 0) {
      units = units_at(line - 1);
      if (!units.empty()) block.unit_line = line - 1;
    }
    for (std::size_t i = 0; i < heading.names.size(); ++i)
      block.columns.push_back(recognise_column(heading.names[i], i < units.size() ? units[i] : ""));
    words_ = next;
    has_frequency_above_ = has_frequency_above_ || !names_frequency(heading.names);
    for (; next < lines_.size() && heading_at(next).names.empty(); ++next) {
      take_row(block, next);
      if (!block.lines.empty()) words_ = block.lines.back() + 1;
    }
    block.begins.push_back(block.cells.size());
    if (block.has_cell_units) take_units_out(block);
    tables_.blocks.push_back(std::move(block));
    return next;
  }

  /// Titles, results of one word and empty lines are no rows.
  void take_row(TableBlock& block, std::size_t line) {
    const Cells cells = cells_at(line);
    const auto numbers = std::count_if(cells.begin(), cells.end(), is_measured);
    if (filled(cells) < 2 || (numbers < 2 && cells.size() < block.columns.size())) return;
    const auto first = std::find_if(cells.begin(), cells.end(), [](auto cell) { return !cell.empty(); });
    if (!is_measured(*first) && is_statistic(plain_words(*first))) {
      ++block.statistics;
      return;
    }
    if (block.lines.empty()) block.has_cell_units = std::any_of(cells.begin(), cells.end(), number_with_unit);
    block.lines.push_back(line);
    block.begins.push_back(block.cells.size());
    block.cells.insert(block.cells.end(), cells.begin(), cells.end());
  }

  const std::vector<std::string_view>& lines_;
  ExportTables tables_;
  std::size_t words_ = 0;  ///< index of the line below the last row
  bool has_frequency_above_ = false;
};

/// Those that may be tried.
std::vector<char> delimiters_of(const std::vector<std::string_view>& lines) {
  const char certain = delimiter_of(lines);
  std::vector<char> delimiters = {certain};
  if (certain == '\0') delimiters = {'\t', ';', ',', '|'};
  for (const char blanks : {kGaps, kBlanks}) {
    if (score_of(lines, blanks) > 0.0) delimiters.push_back(blanks);
  }
  return delimiters;
}

}  // namespace

ExportTables sweep_tables_of(const std::vector<std::string_view>& lines) {
  for (const char delimiter : delimiters_of(lines)) {
    ExportTables tables = SweepFinder(lines, delimiter).find();
    if (!tables.blocks.empty()) return tables;
  }
  return {};
}

std::optional<ImportFault> fault_of_no_frequency(const std::vector<std::string_view>& lines, const std::string& file) {
  Cells cells;
  for (const char delimiter : delimiters_of(lines)) {
    for (std::size_t i = 0; i < std::min(lines.size(), kMostHeaderLines); ++i) {
      split_cells(lines[i], delimiter, cells);
      const auto modulus = std::find_if(cells.begin(), cells.end(), [](std::string_view cell) {
        return has_letter(cell) && recognise_sweep_column(cell).quantity == SweepQuantity::storage_modulus;
      });
      if (filled(cells) < 2 || modulus == cells.end()) continue;
      return ImportFault{
          file, static_cast<int>(i) + 1, std::string(*modulus),
          "a storage modulus, but no column of frequency is with it, expected one such as `Frequency "
          "(Hz)` or `Angular frequency (rad/s)`, or one frequency in the lines above, `Frequency: 1 Hz`, "
          "and a column of temperature or amplitude"};
    }
  }
  return std::nullopt;
}

}  // namespace nacre::measurement
