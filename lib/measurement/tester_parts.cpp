#include "measurement/tester_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "base/csv.hpp"
#include "base/statistics.hpp"
#include "measurement/set_files.hpp"
#include "measurement/tester_numbers.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

constexpr double kBack = 0.05;  // of the range of the extension: as good as its beginning
constexpr double kAway = 0.3;   // of that range: far from the beginning

/// Rows of a table that belong together, before their columns are read.
struct RowGroup {
  std::string name;
  std::vector<std::size_t> rows;
};

const std::vector<double>& abscissa_of(const ColumnSeries& series) {
  return series.column(Quantity::strain) ? series.of(Quantity::strain) : series.of(Quantity::extension);
}
const std::vector<double>& ordinate_of(const ColumnSeries& series) {
  return series.column(Quantity::stress) ? series.of(Quantity::stress) : series.of(Quantity::force);
}

ColumnSeries rows_of_series(const ColumnSeries& series, std::size_t begin, std::size_t end) {
  ColumnSeries part{.taken = series.taken,
                    .strains = series.strains,
                    .decisions = series.decisions,
                    .warnings = series.warnings,
                    .decimal_mark = series.decimal_mark};
  const auto cut = [&](const auto& values) {
    using Values = std::decay_t<decltype(values)>;
    if (values.empty()) return Values{};
    return Values(values.begin() + static_cast<std::ptrdiff_t>(begin),
                  values.begin() + static_cast<std::ptrdiff_t>(end));
  };
  for (std::size_t q = 0; q < kQuantities; ++q) part.values[q] = cut(series.values[q]);
  part.line = cut(series.line);
  return part;
}

void append(ColumnSeries& series, const ColumnSeries& more) {
  for (std::size_t q = 0; q < kQuantities; ++q) {
    if (series.values[q].size() != series.line.size() || more.values[q].size() != more.line.size()) {
      series.values[q].clear();  // a clock that only one of them has
      series.taken[q].reset();
      continue;
    }
    series.values[q].insert(series.values[q].end(), more.values[q].begin(), more.values[q].end());
  }
  series.line.insert(series.line.end(), more.line.begin(), more.line.end());
}

/// Rows at which the record begins anew: the extension falls at once from far away to its beginning, and the force
/// rises again; or the clock does the same.
std::vector<std::size_t> restarts_of(const ColumnSeries& series) {
  const auto &extension = abscissa_of(series), &force = ordinate_of(series), &time = series.of(Quantity::time);
  std::vector<std::size_t> starts{0};
  const double range = range_of(extension), peak = range_of(force);
  for (std::size_t i = 1; i < extension.size(); ++i) {
    const std::size_t start = starts.back();
    const bool clock_back =
        !time.empty() && time[i] < time[i - 1] && time[i] <= time[start] + 0.02 * (time[i - 1] - time[start]);
    const bool far_before = std::abs(extension[i - 1] - extension[start]) > kAway * range;
    const bool back_now = std::abs(extension[i] - extension[start]) < kBack * range;
    if (clock_back || (far_before && back_now && range > 0.0)) starts.push_back(i);
  }
  std::vector<std::size_t> kept{0};
  for (std::size_t k = 1; k < starts.size(); ++k) {
    const std::size_t end = k + 1 < starts.size() ? starts[k + 1] : extension.size();
    double low = force[starts[k]], rise = 0.0;
    for (std::size_t i = starts[k]; i < end; ++i) {
      rise = std::max(rise, force[i] - low);
      low = std::min(low, force[i]);
    }
    const bool long_enough = end - starts[k] >= kFewestCurveRows && starts[k] - kept.back() >= kFewestCurveRows;
    if (long_enough && rise > 0.2 * peak) kept.push_back(starts[k]);
  }
  return kept;
}

/// How far a record has come: what decides whether another one goes on.
struct Extent {
  double first = 0.0, last = 0.0, least = 0.0, most = 0.0, step = 0.0;  ///< of the extension
  std::optional<double> time;                                           ///< its last

  void begin(double value) { *this = {value, value, value, value, 0.0, std::nullopt}; }
  void go_to(double value) {
    step = std::max(step, std::abs(value - last));
    last = value;
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

/// Whether a record goes on at `extension` and `time`: the clock does, or without one the extension.
bool goes_on(const Extent& before, double extension, std::optional<double> time) {
  const double range = before.most - before.least;
  const bool restarted = std::abs(before.last - before.first) > kAway * range &&
                         std::abs(extension - before.first) < kBack * range && range > 0.0;
  if (restarted) return false;
  if (before.time && time) return *time >= *before.time;
  return std::abs(extension - before.last) <= std::max(kBack * range, 3.0 * before.step);
}

std::optional<double> time_at(const ColumnSeries& series, std::size_t row) {
  const auto& time = series.of(Quantity::time);
  return time.empty() ? std::nullopt : std::optional(time[row]);
}

bool goes_on(const ColumnSeries& first, const ColumnSeries& next) {
  const auto &before = abscissa_of(first), &after = abscissa_of(next);
  if (before.empty() || after.empty()) return false;
  Extent extent;
  extent.begin(before.front());
  for (const double value : before) extent.go_to(value);
  extent.time = time_at(first, before.size() - 1);
  return goes_on(extent, after.front(), time_at(next, 0));
}

/// Words of a title that speak of extreme values.
bool is_of_extremes(const std::string& title) {
  constexpr std::array<std::string_view, 14> kWords = {"max",     "min",     "maximum",  "minimum",     "peak",
                                                       "valley",  "extreme", "extremes", "extremwerte", "spitzenwerte",
                                                       "extrema", "peaks",   "pic",      "picco"};
  const std::string words = plain_words(title);
  return std::any_of(kWords.begin(), kWords.end(), [&](std::string_view word) { return holds_word(words, word); });
}

/// Words of a title that name another specimen.
bool names_a_specimen(const std::string& title) {
  const auto known = specimen_words().find_all(plain_words(title));
  return std::any_of(known.begin(), known.end(),
                     [](const FoundWord& each) { return specimen_words().words()[each.index].size() > 3; });
}

class PartFinder {
 public:
  PartFinder(const ExportTables& tables, const ColumnChoice& choice, const std::string& file)
      : tables_(tables), choice_(choice), file_(file) {}

  ExportParts find() {
    for (std::size_t i = 0; i < tables_.blocks.size(); ++i) read_block(i);
    leave_out_extremes();
    leave_out_short();
    check_clocks();
    name_parts();
    return std::move(found_);
  }

 private:
  /// Rows by the value of a column that names the specimen; one group without a name where there is none.
  std::vector<RowGroup> row_groups(const TableBlock& block, const std::vector<std::size_t>& rows) const {
    constexpr std::size_t kFewestRows = 5;
    for (std::size_t column = 0; column < block.columns.size(); ++column) {
      if (!block.columns[column].is_specimen) continue;
      std::vector<RowGroup> groups;
      std::map<std::string, std::size_t> places;
      for (const std::size_t row : rows) {
        const std::string label(block.cell(row, column));
        const auto [place, is_new] = places.try_emplace(label, groups.size());
        if (is_new) groups.push_back({label, {}});
        groups[place->second].rows.push_back(row);
        if (kFewestRows * groups.size() > rows.size() + kFewestRows) break;
      }
      if (groups.size() > 1 && kFewestRows * groups.size() <= rows.size()) return groups;
    }
    return {{"", rows}};
  }

  /// Rows of a group of columns that are not empty in all of them: specimens beside each other end at different rows.
  static std::vector<std::size_t> filled_rows(const TableBlock& block, const ColumnGroup& group, bool is_alone) {
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < block.rows(); ++row) {
      const bool filled =
          is_alone || std::any_of(group.columns.begin(), group.columns.end(), [&](std::size_t column) {
            const auto quantity = block.columns[column].quantity;
            return (quantity == Quantity::force || (quantity == Quantity::extension && !group.shares_extension)) &&
                   !block.cell(row, column).empty();
          });
      if (filled) rows.push_back(row);
    }
    return rows;
  }

  void read_block(std::size_t index) {
    const TableBlock& block = tables_.blocks[index];
    if (block.statistics > 0)
      found_.notes.push_back(
          fmt::format("{}: {} rows of statistics (`Mean`, `SD`) of the table that begins in line {} "
                      "are left out",
                      file_, block.statistics, block.heading + 1));
    if (block.ignored_rows > 0)
      found_.notes.push_back(
          fmt::format("{}: {} rows of numbers after the record that begins in line {} stand below "
                      "other headings and are left out",
                      file_, block.ignored_rows, block.heading + 1));
    const std::vector<ColumnGroup> groups = column_groups(block, choice_);
    for (const ColumnGroup& group : groups) {
      const auto rows = filled_rows(block, group, groups.size() == 1);
      if (rows.empty() && groups.size() > 1) continue;
      for (const RowGroup& of_specimen : row_groups(block, rows)) {
        std::string name = group.name;
        if (!of_specimen.name.empty()) name += (name.empty() ? "" : " ") + of_specimen.name;
        read_rows(block, group, of_specimen.rows, name);
      }
    }
  }

  void read_rows(const TableBlock& block, const ColumnGroup& group, const std::vector<std::size_t>& rows,
                 const std::string& name) {
    if (rows.empty()) {
      return add(block, group, name,
                 tl::unexpected(ImportFault{file_, static_cast<int>(block.heading) + 1, "",
                                            "no numbers below the heading, expected rows of data"}));
    }
    auto series = series_of(block, group.columns, rows, tables_.delimiter, choice_, file_);
    if (!series) return add(block, group, name, tl::unexpected(series.error()));
    std::vector<std::size_t> starts = restarts_of(*series);
    std::vector<std::string> titles(starts.size());
    if (name.empty()) add_breaks(block, *series, rows, starts, titles);
    for (std::size_t k = 0; k < starts.size(); ++k) {
      const std::size_t end = k + 1 < starts.size() ? starts[k + 1] : rows.size();
      ColumnSeries part = starts.size() == 1 ? std::move(*series) : rows_of_series(*series, starts[k], end);
      const std::string title = k == 0 ? block.title : titles[k];
      add(block, group, name, std::move(part), title, k > 0);
    }
  }

  /// Adds the places at which lines of words or empty lines divide records that do not go on.
  void add_breaks(const TableBlock& block, const ColumnSeries& series, const std::vector<std::size_t>& rows,
                  std::vector<std::size_t>& starts, std::vector<std::string>& titles) const {
    std::map<std::size_t, std::string> all;
    for (const std::size_t start : starts) all[start] = "";
    const auto& extension = abscissa_of(series);
    Extent extent;
    extent.begin(extension.front());
    std::size_t seen = 0;
    for (const TableBreak& each : block.breaks) {
      const auto at = static_cast<std::size_t>(std::lower_bound(rows.begin(), rows.end(), each.row) - rows.begin());
      if (at == 0 || at >= rows.size()) continue;
      for (; seen < at; ++seen) {
        if (all.contains(seen)) extent.begin(extension[seen]);
        extent.go_to(extension[seen]);
      }
      extent.time = time_at(series, at - 1);
      const auto known = all.find(at);
      if (known != all.end()) {
        known->second = each.title;
      } else if (names_a_specimen(each.title) || !goes_on(extent, extension[at], time_at(series, at))) {
        all[at] = each.title;
      }
    }
    starts.clear();
    titles.clear();
    for (const auto& [start, title] : all) {
      starts.push_back(start);
      titles.push_back(title);
    }
  }

  void add(const TableBlock& block, const ColumnGroup& group, const std::string& name,
           tl::expected<ColumnSeries, ImportFault> series, const std::string& title = {}, bool is_new = false) {
    Found part{.part = {.name = name, .heading = block.heading, .columns = group.columns, .series = {}, .fault = {}},
               .title = title,
               .headings = {}};
    for (const ColumnName& column : block.columns) part.headings += plain_words(column.heading) + "|";
    if (!series) {
      part.part.fault = series.error();
    } else {
      part.part.series = std::move(*series);
      for (auto earlier = all_.rbegin(); earlier != all_.rend() && !is_new; ++earlier) {
        if (earlier->headings != part.headings || earlier->part.name != name || earlier->part.fault) continue;
        const bool other_specimen = names_a_specimen(title) && title != earlier->title && is_specimen_title(title);
        if (!other_specimen && is_of_extremes(title) == is_of_extremes(earlier->title) &&
            goes_on(earlier->part.series, part.part.series)) {
          append(earlier->part.series, part.part.series);
          ++earlier->joined;
          return;
        }
        break;
      }
    }
    all_.push_back(std::move(part));
  }

  /// `Probe 2`, not a line of settings that speaks of a specimen.
  static bool is_specimen_title(const std::string& title) {
    return title.size() < 40 && title.find(':') == std::string::npos;
  }

  void leave_out(const char* what, auto is_unwanted) {
    for (const auto& each : all_) {
      if (!is_unwanted(each)) continue;
      found_.notes.push_back(fmt::format("{}:{}: a table of {} is left out", file_, each.part.heading + 1, what));
    }
    std::erase_if(all_, is_unwanted);
  }

  /// Blocks of extremes beside a timed record.
  void leave_out_extremes() {
    const auto has_clock = [](const Found& each) { return !each.part.series.of(Quantity::time).empty(); };
    const bool timed = std::any_of(all_.begin(), all_.end(), [&](const Found& each) {
      return has_clock(each) && !is_of_extremes(each.title) && each.rows() >= kFewestCurveRows;
    });
    if (!timed || all_.size() < 2) return;
    leave_out("extreme values",
              [&](const Found& each) { return !each.part.fault && (!has_clock(each) || is_of_extremes(each.title)); });
    leave_out("extreme values", [&](const Found& each) { return each.part.fault && is_of_extremes(each.title); });
  }

  /// Tables of a few rows beside a record: results.
  void leave_out_short() {
    const bool any_long = std::any_of(all_.begin(), all_.end(), [](const Found& each) {
      return each.rows() >= kFewestCurveRows || (each.part.fault && each.part.fault->reason.find("no numbers") != 0);
    });
    if (!any_long || all_.size() < 2) return;
    leave_out("results", [&](const Found& each) {
      const bool is_empty = each.part.fault && each.part.fault->reason.starts_with("no numbers");
      return is_empty || (!each.part.fault && each.rows() < kFewestCurveRows);
    });
  }

  void check_clocks() {
    for (Found& each : all_) {
      const std::vector<double>& time = each.part.series.of(Quantity::time);
      const auto back = std::is_sorted_until(time.begin(), time.end());
      if (back == time.end() || each.part.fault) continue;
      const auto at = static_cast<std::size_t>(back - time.begin());
      each.part.fault = ImportFault{
          file_, each.part.series.line[at], each.part.series.column(Quantity::time)->heading,
          fmt::format(
              "time goes back from {} to {} s, expected one test in the order of time, or time_column in the sheet",
              time[at - 1], time[at])};
    }
  }

  void name_parts() {
    for (std::size_t i = 0; i < all_.size(); ++i) {
      Found& each = all_[i];
      if (each.joined > 0)
        each.part.series.decisions.push_back(fmt::format(
            "{} tables with the same heading are one record: the clock or the extension goes on", each.joined + 1));
      if (each.part.name.empty() && is_specimen_title(each.title) && names_a_specimen(each.title))
        each.part.name = each.title;
      if (each.part.name.empty()) each.part.name = std::to_string(i + 1);
      found_.parts.push_back(std::move(each.part));
    }
  }

  struct Found {
    TesterPart part;
    std::string title, headings;
    int joined = 0;
    std::size_t rows() const { return part.series.line.size(); }
  };

  const ExportTables& tables_;
  const ColumnChoice& choice_;
  const std::string& file_;
  std::vector<Found> all_;
  ExportParts found_;
};

}  // namespace

ExportParts parts_of(const ExportTables& tables, const ColumnChoice& choice, const std::string& file) {
  return PartFinder(tables, choice, file).find();
}

}  // namespace nacre::measurement
