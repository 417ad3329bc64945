#include "measurement/tester_series.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "base/csv.hpp"
#include "measurement/candidate_column.hpp"
#include "measurement/cell_units.hpp"
#include "measurement/decimal_marks.hpp"
#include "measurement/tester_numbers.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

constexpr double kDead = 1e-3;      // range of a dead channel over that of the widest
constexpr double kHalfDay = 43200;  // s

class SeriesReader {
 public:
  SeriesReader(const TableBlock& block, const std::vector<std::size_t>& columns, const std::vector<std::size_t>& rows,
               char delimiter, const ColumnChoice& choice, const std::string& file)
      : block_(block), columns_(columns), rows_(rows), delimiter_(delimiter), choice_(choice), file_(file) {}

  tl::expected<ColumnSeries, ImportFault> read() {
    for (const std::size_t row : rows_) series_.line.push_back(static_cast<int>(block_.lines[row]) + 1);
    for (const std::size_t row : rows_) {
      if ((delimiter_ == kGaps || delimiter_ == kBlanks) && block_.cells_in(row) != block_.columns.size()) {
        reject(block_.lines[row] + 1, "",
               fmt::format("has {} columns, expected {} as in the heading: an empty cell, or fewer than two blanks "
                           "between columns; export with a delimiter",
                           block_.cells_in(row), block_.columns.size()));
        return tl::unexpected(*fault_);
      }
      if (delimiter_ != ',' || block_.cells_in(row) <= block_.columns.size() || !is_torn(row)) continue;
      refuse_torn(row);
      return tl::unexpected(*fault_);
    }
    find_marks();
    const Quantity abscissa = choice_.strain.empty() ? Quantity::extension : Quantity::strain;
    const Quantity ordinate = choice_.stress.empty() ? Quantity::force : Quantity::stress;
    for (const Quantity quantity : {abscissa, ordinate}) {
      take(quantity);
      if (fault_) return tl::unexpected(*fault_);
    }
    for (const std::size_t column : columns_) {
      const ColumnName& name = block_.columns[column];
      if (name.quantity == Quantity::strain && choice_.strain.empty()) series_.strains.push_back(name.heading);
    }
    take_time();
    if (fault_) return tl::unexpected(*fault_);
    return std::move(series_);
  }

 private:
  void reject(std::size_t line, std::string column, std::string reason) {
    if (!fault_) fault_ = ImportFault{file_, static_cast<int>(line), std::move(column), std::move(reason)};
  }

  /// Whether the column may be taken for a quantity, so that its numbers matter.
  bool matters(std::size_t column) const {
    const ColumnName& name = block_.columns[column];
    if (name.quantity && *name.quantity != Quantity::strain && *name.quantity != Quantity::stress) return true;
    for (const Quantity quantity :
         {Quantity::time, Quantity::extension, Quantity::force, Quantity::strain, Quantity::stress}) {
      if (match(name.heading, name.name, choice_.of(quantity)) > 0) return true;
    }
    return false;
  }

  void find_marks() {
    std::vector<std::size_t> columns;
    std::copy_if(columns_.begin(), columns_.end(), std::back_inserter(columns),
                 [&](std::size_t column) { return matters(column); });
    marks_ = decimal_marks(block_, columns, rows_, delimiter_);
    if (marks_.is_assumed) series_.warnings.push_back(doubt_of_marks(marks_, file_));
    series_.decimal_mark = marks_.usual == DecimalMark::comma ? ',' : '.';
  }

  std::optional<double> value_at(std::size_t row, std::size_t column) const {
    return instrument_number(block_.cell(row, column), marks_.of(column));
  }

  /// Range of a column's numbers, and how many of its cells are none.
  std::pair<double, std::size_t> range_of(std::size_t column) const {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    std::size_t others = 0;
    for (const std::size_t row : rows_) {
      const auto value = value_at(row, column);
      if (!value) {
        ++others;
        continue;
      }
      least = std::min(least, *value);
      most = std::max(most, *value);
    }
    return {most >= least ? most - least : 0.0, others};
  }

  bool has_unit(const ColumnName& name, Quantity quantity) const {
    return !name.unit.empty() && unit_factor(quantity, name.unit).has_value();
  }

  std::vector<CandidateColumn> candidates_for(Quantity quantity) const {
    std::vector<CandidateColumn> found;
    const std::string& wanted = choice_.of(quantity);
    int best_match = 0;
    for (const std::size_t column : columns_) {
      const ColumnName& name = block_.columns[column];
      const int matched = match(name.heading, name.name, wanted);
      if (wanted.empty() ? name.quantity != quantity : matched == 0) continue;
      found.push_back({.column = column, .name = &name, .match = matched, .has_unit = has_unit(name, quantity)});
      best_match = std::max(best_match, matched);
    }
    std::erase_if(found, [&](const CandidateColumn& each) { return each.match < best_match; });
    return found;
  }

  /// Whether a column stays at its largest number, to the last digit, for a twentieth of its rows and ten at least.
  bool is_cut(std::size_t column) const {
    constexpr std::size_t kFewest = 10, kShare = 20;
    double largest = -std::numeric_limits<double>::infinity();
    std::size_t run = 0, longest = 0;
    for (const std::size_t row : rows_) {
      const double value = value_at(row, column).value_or(-std::numeric_limits<double>::infinity());
      run = value < largest ? 0 : value > largest ? 1 : run + 1;
      longest = value > largest ? 1 : std::max(longest, run);
      largest = std::max(largest, value);
    }
    return longest >= kFewest && kShare * longest > rows_.size();
  }

  /// Marks the channels that do not move, against the one that moves most.
  void find_dead(std::vector<CandidateColumn>& candidates, Quantity quantity) const {
    if (candidates.size() < 2) return;
    std::vector<double> ranges;
    for (CandidateColumn& each : candidates) {
      const auto [range, others] = range_of(each.column);
      const double factor = each.has_unit ? unit_factor(quantity, each.name->unit).value_or(1.0) : 0.0;
      each.is_dead = range == 0.0 || 2 * others > rows_.size();
      each.is_cut = quantity == Quantity::force && !each.is_dead && is_cut(each.column);
      ranges.push_back(each.is_dead || each.name->role != ColumnRole::measured ? 0.0 : range * factor);
    }
    const double widest = *std::max_element(ranges.begin(), ranges.end());
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (candidates[i].has_unit && candidates[i].name->role == ColumnRole::measured && ranges[i] < kDead * widest)
        candidates[i].is_dead = true;
    }
  }

  /// Whether two columns rise and fall differently, by more than 1 % of the range of the first.
  bool differ(const CandidateColumn& one, const CandidateColumn& other, Quantity quantity) const {
    constexpr double kAlike = 0.01;
    const auto factor = [&](const CandidateColumn& each) {
      return unit_factor(quantity, each.name->unit).value_or(1.0);
    };
    std::optional<double> first, first_other;
    double most = 0.0;
    for (const std::size_t row : rows_) {
      const auto value = value_at(row, one.column), beside = value_at(row, other.column);
      if (!value || !beside) continue;
      if (!first) first = *value, first_other = *beside;
      most = std::max(most, std::abs(factor(one) * (*value - *first) - factor(other) * (*beside - *first_other)));
    }
    return most > kAlike * factor(one) * range_of(one.column).first;
  }

  /// A warning where nothing but their places decided between columns that differ.
  void doubt_choice(Quantity quantity, const CandidateColumn& taken, const std::vector<CandidateColumn>& all) {
    for (const CandidateColumn& other : all) {
      if (other.column == taken.column || order_of(other) != order_of(taken) || !differ(taken, other, quantity))
        continue;
      series_.warnings.push_back(fmt::format(
          "{}: `{}` and `{}` are both measured columns of {} and differ; the first is taken: expected {}_column in the "
          "sheet, or part where they are of two specimens",
          file_, taken.name->heading, other.name->heading, to_string(quantity), to_string(quantity)));
      return;
    }
  }

  void say_choice(Quantity quantity, const CandidateColumn& taken, const std::vector<CandidateColumn>& all,
                  TakenColumn& column) {
    std::vector<std::string> others;
    for (const CandidateColumn& other : all) {
      if (other.column == taken.column) continue;
      column.not_taken.push_back(other.name->heading);
      others.push_back(fmt::format("`{}` ({})", other.name->heading,
                                   taken.match > 0 ? "not named by the sheet" : reason_for(taken, other)));
      if (taken.match == 0 && other.is_dead && !taken.is_dead && other.name->role == ColumnRole::measured)
        series_.warnings.push_back(
            fmt::format("{}: column `{}` does not move and is left out, `{}` is taken for the {}", file_,
                        other.name->heading, taken.name->heading, to_string(quantity)));
    }
    for (const std::size_t i : columns_) {
      const ColumnName& name = block_.columns[i];
      const auto is_it = [&](const CandidateColumn& each) { return each.column == i; };
      if (name.quantity != quantity || std::any_of(all.begin(), all.end(), is_it)) continue;
      column.not_taken.push_back(name.heading);
      others.push_back(fmt::format("`{}` (not named by the sheet)", name.heading));
    }
    if (others.empty()) return;
    series_.decisions.push_back(
        fmt::format("{}: `{}` taken, not {}", to_string(quantity), taken.name->heading, fmt::join(others, ", ")));
  }

  std::vector<std::string> headings() const {
    std::vector<std::string> names;
    for (const std::size_t column : columns_) {
      if (!block_.columns[column].heading.empty()) names.push_back(block_.columns[column].heading);
    }
    return names;
  }

  void take(Quantity quantity) {
    std::vector<CandidateColumn> all = candidates_for(quantity);
    find_dead(all, quantity);
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
      return std::tuple(order_of(a), a.column) < std::tuple(order_of(b), b.column);
    });
    const bool by_name = !choice_.of(quantity).empty();
    const auto may_be_taken = [&](const CandidateColumn& each) {
      return by_name || (each.name->role != ColumnRole::set_point && each.name->role != ColumnRole::lateral);
    };
    // A channel that moves though nobody measured with it is worse than a dead measurement.
    const auto taken = std::find_if(all.begin(), all.end(), may_be_taken);
    if (taken == all.end()) return refuse_absent(quantity, all);
    TakenColumn column{.heading = taken->name->heading, .gauge = taken->name->gauge};
    say_choice(quantity, *taken, all, column);
    if (taken->match < 3) doubt_choice(quantity, *taken, all);
    if (!find_factor(quantity, *taken->name, column)) return;
    if (marks_.contradict(taken->column)) return reject(marks_.contradiction, "", fault_of_marks(marks_));
    const bool falls = quantity == Quantity::extension && choice_.extension_falls;
    if (falls)
      series_.decisions.push_back(
          fmt::format("extension: `{}` counts downwards in tension, as the sheet says", taken->name->heading));
    read_values(quantity, taken->column, falls ? -column.factor : column.factor);
    series_.taken[static_cast<std::size_t>(quantity)] = std::move(column);
  }

  void refuse_absent(Quantity quantity, const std::vector<CandidateColumn>& all) {
    const std::string& wanted = choice_.of(quantity);
    if (!wanted.empty()) {
      return reject(block_.heading + 1, std::string(to_string(quantity)),
                    fmt::format("no column `{}` among `{}`", wanted, fmt::join(headings(), "`, `")));
    }
    std::vector<std::string> others;
    for (const CandidateColumn& each : all) others.push_back(each.name->heading);
    reject(
        block_.heading + 1, std::string(to_string(quantity)),
        fmt::format("no measured column of {}, but `{}`, a set point or across the specimen; expected {}_column in the "
                    "sheet where one of them is meant",
                    to_string(quantity), fmt::join(others, "`, `"), to_string(quantity)));
  }

  /// The unit of the heading, else that of the sheet, else none, which import_one() decides on.
  bool find_factor(Quantity quantity, const ColumnName& name, TakenColumn& column) {
    if (!name.other_unit.empty()) {
      reject(block_.unit_line + 1, name.heading,
             fmt::format("`{}` in the heading, `{}` in the row of units, expected one unit; correct the export",
                         unit_as_written(name.unit), unit_as_written(name.other_unit)));
      return false;
    }
    if (const auto factor = unit_factor(quantity, name.unit); factor && !name.unit.empty()) {
      column.unit = name.unit;
      column.factor = *factor;
      if (name.unit_of_cells)
        series_.decisions.push_back(
            fmt::format("{}: `{}` in {}, as its cells say", to_string(quantity), name.heading, name.unit));
      return true;
    }
    for (const std::string& unit : units_of_sheet(choice_)) {
      const auto factor = unit_factor(quantity, unit);
      if (!factor) continue;
      column.unit = unit;
      column.factor = *factor;
      column.unit_of_sheet = true;
      series_.decisions.push_back(
          fmt::format("{}: `{}` in {}, as the sheet says", to_string(quantity), name.heading, unit));
      return true;
    }
    if (name.unit.empty() || quantity == Quantity::time) return true;
    reject(block_.unit_line + 1, name.heading,
           fmt::format("`{}` is not a unit of {}, expected one of {}, or the column `unit` in the sheet", name.unit,
                       to_string(quantity), expected_units(quantity)));
    return false;
  }

  void read_values(Quantity quantity, std::size_t column, double factor) {
    std::vector<double>& values = series_.of(quantity);
    values.reserve(rows_.size());
    for (const std::size_t row : rows_) {
      const auto value = value_at(row, column);
      if (!value) return refuse_value(quantity, row, column);
      values.push_back(*value * factor);
    }
  }

  void refuse_value(Quantity quantity, std::size_t row, std::size_t column) {
    const std::string& heading = block_.columns[column].heading;
    const std::size_t line = block_.lines[row] + 1, cells = block_.cells_in(row);
    const std::string_view text = block_.cell(row, column);
    if (column >= cells)
      return reject(line, heading,
                    fmt::format("the row has {} cells, expected {}; is the file cut off or edited?", cells,
                                block_.columns.size()));
    if (const std::string units = fault_of_units(block_, column); number_with_unit(text) && !units.empty())
      return reject(line, heading, units);
    if (!looks_like_number(text))
      return reject(
          line, heading,
          fmt::format("`{}` is not a number, expected {}; is the file cut off or edited?", text, to_string(quantity)));
    reject(line, heading,
           fmt::format("`{}` is not a number with a decimal {}, expected {}", text,
                       marks_.of(column) == DecimalMark::comma ? "comma" : "point", to_string(quantity)));
  }

  /// A row that was torn at its decimal commas has numbers beyond the heading's last column.
  bool is_torn(std::size_t row) const {
    for (std::size_t i = block_.columns.size(); i < block_.cells_in(row); ++i) {
      if (looks_like_number(block_.cell(row, i)) || number_with_unit(block_.cell(row, i))) return true;
    }
    return false;
  }
  void refuse_torn(std::size_t row) {
    reject(block_.lines[row] + 1, "",
           fmt::format("has {} cells, expected {}: decimal commas in a comma-separated file?", block_.cells_in(row),
                       block_.columns.size()));
  }

  /// Seconds of the day or of a duration, past midnight, too.
  std::optional<std::vector<double>> clock_times(std::size_t column) const {
    std::vector<double> times;
    for (const std::size_t row : rows_) {
      auto seconds = clock_seconds(block_.cell(row, column));
      if (!seconds) return std::nullopt;
      while (!times.empty() && *seconds < times.back() - kHalfDay) *seconds += 2.0 * kHalfDay;
      times.push_back(*seconds);
    }
    if (!times.empty()) {
      const double first = times.front();
      for (double& time : times) time -= first;
    }
    return times;
  }

  std::optional<std::vector<double>> times_in(std::size_t column) const {
    if (!rows_.empty() && clock_seconds(block_.cell(rows_.front(), column))) return clock_times(column);
    std::vector<double> times;
    for (const std::size_t row : rows_) {
      const auto value = value_at(row, column);
      if (!value) return std::nullopt;
      times.push_back(*value);
    }
    return times;
  }

  /// The clock is not needed for the curve: one that cannot be read is left out with a word, unless the sheet names it.
  void take_time() {
    std::vector<CandidateColumn> all = candidates_for(Quantity::time);
    const bool by_name = !choice_.time.empty();
    if (all.empty() && by_name) return refuse_absent(Quantity::time, all);
    std::map<std::size_t, std::vector<double>> times;
    for (CandidateColumn& each : all) {
      auto values = times_in(each.column);
      if (!values) {
        each.is_dead = true;
        continue;
      }
      each.is_clock_time = !rows_.empty() && clock_seconds(block_.cell(rows_.front(), each.column)).has_value();
      each.goes_back = !std::is_sorted(values->begin(), values->end());
      each.is_dead = values->size() > 1 && values->front() == values->back() && !each.goes_back;
      times.emplace(each.column, std::move(*values));
    }
    std::sort(all.begin(), all.end(), [](const CandidateColumn& a, const CandidateColumn& b) {
      const auto order = [](const CandidateColumn& each) {
        return std::tuple(each.goes_back, each.is_dead, each.name->rank, !each.has_unit && !each.is_clock_time,
                          each.column);
      };
      return order(a) < order(b);
    });
    if (all.empty()) return;
    const CandidateColumn& taken = all.front();
    const auto values = times.find(taken.column);
    if (values == times.end()) return leave_out_time(taken, by_name);
    if (!taken.name->other_unit.empty() && !by_name) {
      series_.warnings.push_back(fmt::format(
          "{}:{}: column `{}` is in `{}` by its heading, in `{}` by the row of units; the clock is not used", file_,
          block_.unit_line + 1, taken.name->heading, unit_as_written(taken.name->unit),
          unit_as_written(taken.name->other_unit)));
      return;
    }
    TakenColumn column{.heading = taken.name->heading};
    say_choice(Quantity::time, taken, all, column);
    if (taken.is_clock_time) {
      column.unit = "h:min:s";
    } else {
      find_factor(Quantity::time, *taken.name, column);
      for (double& time : values->second) time *= column.factor;
    }
    series_.of(Quantity::time) = std::move(values->second);
    series_.taken[static_cast<std::size_t>(Quantity::time)] = std::move(column);
  }

  void leave_out_time(const CandidateColumn& clock, bool by_name) {
    for (const std::size_t row : rows_) {
      const std::string_view cell = block_.cell(row, clock.column);
      if (value_at(row, clock.column) || clock_seconds(cell)) continue;
      const std::string reason = fmt::format("`{}` is neither a number nor a time", cell);
      if (by_name) return reject(block_.lines[row] + 1, clock.name->heading, reason + ", expected time");
      series_.warnings.push_back(fmt::format("{}:{}: column `{}`: {}; the clock is not used", file_,
                                             block_.lines[row] + 1, clock.name->heading, reason));
      return;
    }
  }

  const TableBlock& block_;
  const std::vector<std::size_t>& columns_;
  const std::vector<std::size_t>& rows_;
  char delimiter_;
  const ColumnChoice& choice_;
  const std::string& file_;
  ColumnSeries series_;
  DecimalMarks marks_;
  std::optional<ImportFault> fault_;
};

}  // namespace

std::optional<std::vector<double>> numbers_of(const TableBlock& block, std::size_t column,
                                              const std::vector<std::size_t>& rows, char delimiter) {
  std::vector<std::string_view> cells;
  for (const std::size_t row : rows) cells.push_back(block.cell(row, column));
  const DecimalMark mark = column_mark(cells).mark.value_or(delimiter == ',' ? DecimalMark::point : DecimalMark::comma);
  std::vector<double> values;
  for (const std::string_view cell : cells) {
    auto value = instrument_number(cell, mark);
    if (!value) value = clock_seconds(cell);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

tl::expected<ColumnSeries, ImportFault> series_of(const TableBlock& block, const std::vector<std::size_t>& columns,
                                                  const std::vector<std::size_t>& rows, char delimiter,
                                                  const ColumnChoice& choice, const std::string& file) {
  return SeriesReader(block, columns, rows, delimiter, choice, file).read();
}

}  // namespace nacre::measurement
