#include "measurement/tester_export.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "base/csv.hpp"
#include "measurement/set_files.hpp"
#include "measurement/tester_columns.hpp"
#include "measurement/tester_header.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

constexpr std::array kQuantities = {Quantity::time, Quantity::extension, Quantity::force};

using Cells = std::vector<std::string>;

std::size_t place_of(Quantity quantity) { return static_cast<std::size_t>(quantity); }

/// Positions of the wanted columns of a block, and their factors to s, mm, N.
struct ColumnLayout {
  std::vector<ColumnName> names;
  std::array<std::size_t, 3> column{};  ///< by Quantity; names.size() when absent
  std::array<double, 3> factor{1.0, 1.0, 1.0};
  bool has(Quantity quantity) const { return column[place_of(quantity)] < names.size(); }
};

/// A heading row has names for extension and force; numbers are not names.
ColumnLayout layout_of(const Cells& cells, const ColumnChoice& choice) {
  ColumnLayout layout;
  for (const std::string& cell : cells)
    layout.names.push_back(looks_like_number(cell) ? ColumnName{cell, {}, 0, {}, {}} : recognise_column(cell));
  layout.column[0] = best_column(layout.names, Quantity::time);
  layout.column[1] = best_column(layout.names, Quantity::extension, choice.extension);
  layout.column[2] = best_column(layout.names, Quantity::force, choice.force);
  return layout;
}

class ExportReader {
 public:
  ExportReader(const std::string& text, std::string file, const ColumnChoice& choice)
      : file_(std::move(file)), choice_(choice), lines_(lines_of(text)) {}

  tl::expected<std::vector<TesterRecord>, ImportFault> read() {
    const std::optional<std::size_t> heading = find_heading();
    if (!heading && !is_bare_table()) return tl::unexpected(no_heading());
    std::size_t next = 0;
    if (!heading) {
      read_bare_table();
    } else {
      header_ = header_of(std::span(lines_).first(*heading), delimiter_);
      for (next = *heading; next < lines_.size() && !fault_;) next = read_block(next);
    }
    if (!fault_ && records_.empty()) reject(0, "", "holds no numbers, expected rows of extension and force");
    if (fault_) return tl::unexpected(*fault_);
    return std::move(records_);
  }

 private:
  void reject(std::size_t line, std::string column, std::string reason) {
    if (!fault_) fault_ = ImportFault{file_, static_cast<int>(line), std::move(column), std::move(reason)};
  }
  Cells cells(std::size_t index) const { return cells_of(lines_[index], delimiter_); }
  bool is_blank(std::size_t index) const {
    return lines_[index].find_first_not_of(" \t,;|\"") == std::string_view::npos;
  }
  bool is_mts() const { return is_mts_793(lines_); }

  /// The first line that holds names of extension and force, and the delimiter between them.
  std::optional<std::size_t> find_heading() {
    std::optional<std::size_t> found;
    std::size_t most_names = 0;
    for (const char delimiter : {'\t', ';', ',', '|'}) {
      const std::size_t end = found ? *found + 1 : std::min(lines_.size(), kMostHeaderLines);
      for (std::size_t i = 0; i < end; ++i) {
        const ColumnLayout layout = layout_of(cells_of(lines_[i], delimiter), choice_);
        if (!layout.has(Quantity::extension) || !layout.has(Quantity::force)) continue;
        if (found && i == *found && layout.names.size() <= most_names) break;
        found = i;
        most_names = layout.names.size();
        delimiter_ = delimiter;
        break;
      }
    }
    return found;
  }

  /// The fault of a file without heading, from the line that resembles one most.
  ImportFault no_heading() const {
    for (const char delimiter : {'\t', ';', ',', '|'}) {
      for (std::size_t i = 0; i < std::min(lines_.size(), kMostHeaderLines); ++i) {
        const Cells here = cells_of(lines_[i], delimiter);
        const ColumnLayout layout = layout_of(here, choice_);
        if (here.size() < 2 || layout.has(Quantity::extension) == layout.has(Quantity::force)) continue;
        const Quantity missing = layout.has(Quantity::force) ? Quantity::extension : Quantity::force;
        const std::string& asked = missing == Quantity::extension ? choice_.extension : choice_.force;
        return {file_, static_cast<int>(i) + 1, std::string(to_string(missing)),
                asked.empty() ? fmt::format("no column of {} among `{}`, expected a name such as {}",
                                            to_string(missing), fmt::join(here, "`, `"), expected_names(missing))
                              : fmt::format("no column `{}` among `{}`", asked, fmt::join(here, "`, `"))};
      }
    }
    const bool is_empty = std::all_of(lines_.begin(), lines_.end(), [](auto line) { return trimmed(line).empty(); });
    return {file_, 0, "",
            is_empty
                ? "is empty, expected a table of time, extension and force"
                : fmt::format("no heading with extension and force, expected names such as {}, and {}, separated by "
                              "commas, semicolons, tabs or bars; stress and strain go into a measurement set as a "
                              "curve, strain,stress_pa",
                              expected_names(Quantity::extension), expected_names(Quantity::force))};
  }

  /// A factor for each column from the heading or the row of units below it; true when that row was there.
  bool read_units(ColumnLayout& layout, std::size_t heading, std::size_t below, std::vector<std::string>& warnings) {
    const Cells units = below < lines_.size() ? cells(below) : Cells{};
    const bool is_numbers =
        std::any_of(units.begin(), units.end(), [](const auto& cell) { return looks_like_number(cell); });
    bool used = false;
    for (const Quantity quantity : kQuantities) {
      if (!layout.has(quantity)) continue;
      const std::size_t column = layout.column[place_of(quantity)];
      const ColumnName& name = layout.names[column];
      const bool from_below = name.unit.empty() && !is_numbers && column < units.size() && !units[column].empty();
      const std::string unit = from_below ? units[column] : name.unit;
      used = used || from_below || (!is_numbers && column < units.size() && unit_factor(quantity, units[column]));
      if (unit.empty()) {
        const std::string_view assumed = quantity == Quantity::force ? "N" : quantity == Quantity::time ? "s" : "mm";
        warnings.push_back(
            fmt::format("{}:{}: column `{}` has no unit, {} is assumed", file_, heading + 1, name.heading, assumed));
        continue;
      }
      const auto factor = unit_factor(quantity, unit);
      if (!factor) {
        reject((from_below ? below : heading) + 1, name.heading,
               fmt::format("`{}` is not a unit of {}, expected one of {}", unit, to_string(quantity),
                           expected_units(quantity)));
        return used;
      }
      layout.factor[place_of(quantity)] = *factor;
    }
    return used;
  }

  /// Reads the block with its heading at line `heading`; returns the line after it.
  std::size_t read_block(std::size_t heading) {
    ColumnLayout layout = layout_of(cells(heading), choice_);
    std::vector<std::string> warnings;
    std::size_t next = heading + 1;
    while (next < lines_.size() && is_blank(next)) ++next;
    if (read_units(layout, heading, next, warnings)) ++next;
    if (fault_) return lines_.size();
    return read_rows(layout, next, warnings);
  }

  bool is_heading(std::size_t index) const {
    const ColumnLayout layout = layout_of(cells(index), choice_);
    return layout.has(Quantity::extension) && layout.has(Quantity::force);
  }

  /// A row of data has a number in both needed columns, or in one of them when it is damaged.
  int numbers_in(const Cells& row, const ColumnLayout& layout) const {
    int numbers = 0;
    for (const Quantity quantity : {Quantity::extension, Quantity::force}) {
      const std::size_t column = layout.column[place_of(quantity)];
      numbers += column < row.size() && looks_like_number(row[column]);
    }
    return numbers;
  }

  std::string damage_of(const Cells& row, const ColumnLayout& layout, std::string& column_name) const {
    for (const Quantity quantity : {Quantity::extension, Quantity::force}) {
      const std::size_t column = layout.column[place_of(quantity)];
      column_name = layout.names[column].heading;
      if (column >= row.size())
        return fmt::format("the row has {} cells, expected {}", row.size(), layout.names.size());
      if (!looks_like_number(row[column]))
        return fmt::format("`{}` is not a number, expected {}", row[column], to_string(quantity));
    }
    return "";
  }

  /// The rows of numbers up to the next heading or the end. A row of words ends a block, but in the middle of the
  /// numbers it is damage; what follows an empty line (a table of results) is not.
  std::size_t read_rows(const ColumnLayout& layout, std::size_t begin, const std::vector<std::string>& warnings) {
    std::vector<std::pair<std::size_t, Cells>> rows;
    std::optional<std::size_t> doubtful;
    std::size_t next = begin;
    bool after_blank = false, is_over = false;
    for (; next < lines_.size(); ++next) {
      if (is_blank(next)) {
        after_blank = true;
        continue;
      }
      Cells row = cells(next);
      const int numbers = numbers_in(row, layout);
      if (numbers < 2 && is_heading(next)) break;
      if (is_over) continue;
      if (numbers == 2) {
        if (doubtful) break;
        after_blank = false;
        rows.emplace_back(next, std::move(row));
        if (rows.size() > kMostCurveRows) {
          reject(next + 1, "", fmt::format("more than {} rows, expected at most that many", kMostCurveRows));
          return lines_.size();
        }
        continue;
      }
      if (is_mts() && numbers == 0) continue;  // "Data Acquisition ..." between two blocks
      if (after_blank && !rows.empty()) {
        is_over = true;
        continue;
      }
      if (!doubtful) doubtful = next;
      if (numbers == 1) break;
    }
    if (doubtful && (next < lines_.size() && numbers_in(cells(next), layout) > 0)) {
      std::string column;
      const std::string reason = damage_of(cells(*doubtful), layout, column);
      reject(*doubtful + 1, column, reason + "; is the file cut off or edited?");
      return lines_.size();
    }
    if (!rows.empty()) take_rows(layout, rows, warnings);
    if (rows.empty() && !doubtful && !is_mts())
      reject(begin, "", "no numbers below the heading, expected rows of data");
    if (rows.empty() && doubtful) {
      std::string column;
      const std::string reason = damage_of(cells(*doubtful), layout, column);
      reject(*doubtful + 1, column, reason);
    }
    return next;
  }

  std::optional<DecimalMark> decimal_mark(const ColumnLayout& layout,
                                          const std::vector<std::pair<std::size_t, Cells>>& rows) {
    std::array<std::optional<std::size_t>, 2> first_seen;
    for (const auto& [index, row] : rows) {
      for (const Quantity quantity : kQuantities) {
        const std::size_t column = layout.column[place_of(quantity)];
        if (column >= row.size()) continue;
        const auto mark = decimal_evidence(row[column]);
        if (mark && !first_seen[static_cast<std::size_t>(*mark)]) first_seen[static_cast<std::size_t>(*mark)] = index;
      }
    }
    if (first_seen[0] && first_seen[1]) {
      const auto later = std::max(*first_seen[0], *first_seen[1]), earlier = std::min(*first_seen[0], *first_seen[1]);
      reject(later + 1, "",
             fmt::format("decimal points and decimal commas in one file (line {} has the other mark), "
                         "expected one of them throughout",
                         earlier + 1));
      return std::nullopt;
    }
    const bool comma = first_seen[1] || (!first_seen[0] && delimiter_ != ',');
    return comma ? DecimalMark::comma : DecimalMark::point;
  }

  /// A row that was torn at its decimal commas has numbers beyond the heading's last column.
  bool is_torn(const Cells& row, const ColumnLayout& layout) const {
    return delimiter_ == ',' && row.size() > layout.names.size() &&
           std::any_of(row.begin() + static_cast<std::ptrdiff_t>(layout.names.size()), row.end(),
                       [](const auto& cell) { return looks_like_number(cell); });
  }

  void name_extension(const ColumnLayout& layout, TesterRecord& record) const {
    const std::size_t taken = layout.column[place_of(Quantity::extension)];
    record.extension_column = layout.names[taken].heading;
    record.gauge = layout.names[taken].gauge;
    for (std::size_t i = 0; i < layout.names.size() && choice_.extension.empty(); ++i) {
      if (i != taken && layout.names[i].quantity == Quantity::extension)
        record.other_extensions.push_back(layout.names[i].heading);
    }
  }

  void take_rows(const ColumnLayout& layout, const std::vector<std::pair<std::size_t, Cells>>& rows,
                 const std::vector<std::string>& warnings) {
    for (const auto& [index, row] : rows) {
      if (!is_torn(row, layout)) continue;
      return reject(index + 1, "",
                    fmt::format("has {} cells, expected {}: decimal commas in a comma-separated file?", row.size(),
                                layout.names.size()));
    }
    const auto mark = decimal_mark(layout, rows);
    if (!mark) return;
    if (records_.empty() || !is_mts()) {
      records_.push_back({.maker = maker_of(lines_, delimiter_),
                          .time_s = {},
                          .extension_mm = {},
                          .force_n = {},
                          .line = {},
                          .header = header_,
                          .extension_column = {},
                          .gauge = Gauge::unknown,
                          .other_extensions = {},
                          .warnings = warnings});
      name_extension(layout, records_.back());
    }
    TesterRecord& record = records_.back();
    for (const auto& [index, row] : rows) {
      for (const Quantity quantity : kQuantities) {
        if (!layout.has(quantity)) continue;
        const std::size_t column = layout.column[place_of(quantity)];
        const std::string text = column < row.size() ? row[column] : "";
        const auto value = instrument_number(text, *mark);
        if (!value) {
          return reject(index + 1, layout.names[column].heading,
                        fmt::format("`{}` is not a number with a decimal {}, expected {}", text,
                                    *mark == DecimalMark::comma ? "comma" : "point", to_string(quantity)));
        }
        append(record, quantity, *value * layout.factor[place_of(quantity)]);
      }
      record.line.push_back(static_cast<int>(index) + 1);
      const std::size_t n = record.time_s.size();
      if (layout.has(Quantity::time) && n > 1 && record.time_s[n - 1] < record.time_s[n - 2]) {
        return reject(index + 1, layout.names[layout.column[0]].heading,
                      fmt::format("time goes back from {} to {} s, expected one test in the order of time",
                                  record.time_s[n - 2], record.time_s[n - 1]));
      }
    }
  }

  static void append(TesterRecord& record, Quantity quantity, double value) {
    (quantity == Quantity::time        ? record.time_s
     : quantity == Quantity::extension ? record.extension_mm
                                       : record.force_n)
        .push_back(value);
  }

  /// Two or three columns of numbers and nothing else: (time,) extension, force in s, mm, N.
  bool is_bare_table() {
    if (!choice_.extension.empty() || !choice_.force.empty()) return false;
    for (const char delimiter : {'\t', ';', ','}) {
      std::size_t first = 0;
      while (first < lines_.size() && is_blank(first)) ++first;
      if (first + kFewestCurveRows > lines_.size()) return false;
      const Cells row = cells_of(lines_[first], delimiter);
      const bool numbers =
          std::all_of(row.begin(), row.end(), [](const auto& cell) { return looks_like_number(cell); });
      if (!numbers || row.size() < 2 || row.size() > 3) continue;
      delimiter_ = delimiter;
      return true;
    }
    return false;
  }

  void read_bare_table() {
    std::size_t first = 0;
    while (is_blank(first)) ++first;
    const bool has_time = cells(first).size() == 3;
    ColumnLayout layout;
    for (const char* name : {"time", "extension", "force"}) {
      if (has_time || std::string_view(name) != "time") layout.names.push_back(recognise_column(name));
    }
    layout.column = {has_time ? 0 : layout.names.size(), has_time ? std::size_t{1} : 0, layout.names.size() - 1};
    read_rows(layout, first,
              {fmt::format("{}: has no heading, {}extension in mm, force in N are assumed", file_,
                           has_time ? "time in s, " : "")});
  }

  std::string file_;
  ColumnChoice choice_;
  std::vector<std::string_view> lines_;
  char delimiter_ = ',';
  std::map<std::string, std::string> header_;
  std::vector<TesterRecord> records_;
  std::optional<ImportFault> fault_;
};

}  // namespace

std::string to_string(const ImportFault& fault) {
  std::string place = fault.file;
  if (fault.line > 0) place += fmt::format(":{}", fault.line);
  if (!fault.column.empty()) place += fmt::format(": {}", fault.column);
  return fmt::format("{}: {}", place, fault.reason);
}

tl::expected<std::vector<TesterRecord>, ImportFault> read_tester_export(std::string_view bytes, const std::string& file,
                                                                        const ColumnChoice& choice) {
  const Result<std::string> text = utf8_from_instrument(bytes);
  if (!text) return tl::unexpected(ImportFault{file, 0, "", text.error().message});
  return ExportReader(*text, file, choice).read();
}

}  // namespace nacre::measurement
