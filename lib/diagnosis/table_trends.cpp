#include "diagnosis/table_trends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "base/random.hpp"
#include "base/result.hpp"
#include "base/statistics.hpp"

namespace nacre::diagnosis {
namespace {

constexpr int kLeastRows = 5;

using NumberColumn = std::vector<std::optional<double>>;

struct TrendTable {
  std::vector<std::pair<std::string, NumberColumn>> columns;  ///< by name, in the order of the heading
  std::vector<measurement::RejectedRow> rejected;
};

/// Names of the columns. Throws InputError when one stands twice.
std::vector<std::string> read_heading(CsvReader& reader, const std::string& source) {
  CsvRow row;
  if (!reader.next(row)) throw InputError::format("{}: is empty, expected a header", source);
  if (!row.fault.empty()) throw InputError::format("{}:{}:{}: {}", source, row.fault_line, row.fault_column, row.fault);
  std::vector<std::string> names;
  for (const CsvCell& cell : row.cells) {
    const std::string name(trimmed(cell.text));
    if (!name.empty() && std::find(names.begin(), names.end(), name) != names.end())
      throw InputError::format("{}:{}: column `{}` stands twice, expected once", source, row.line, name);
    names.push_back(name);
  }
  return names;
}

std::size_t position_of(const std::vector<std::string>& names, const std::string& name, const std::string& source) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw InputError::format("{}: line 1: has no column `{}`, only `{}`{}", source, name, fmt::join(names, "`, `"),
                             names.size() == 1 ? other_separator(names.front()) : "");
  return static_cast<std::size_t>(found - names.begin());
}

/// What keeps the row as a whole from being used.
std::optional<measurement::RejectedRow> fault_of_shape(const CsvRow& row, const std::vector<std::string>& names) {
  const std::size_t expected = names.size();
  if (!row.fault.empty()) {
    const std::string column = row.cells.size() <= expected ? names[row.cells.size() - 1] : "";
    return {{row.fault_line, column, fmt::format("{} (character {})", row.fault, row.fault_column)}};
  }
  std::size_t filled = row.cells.size();
  while (filled > expected && trimmed(row.cells[filled - 1].text).empty()) --filled;
  if (filled == expected) return std::nullopt;
  return {{row.line, "", fmt::format("has {} cells, expected {} as in the heading", row.cells.size(), expected)}};
}

/// `nan` and `inf` as instruments and spreadsheets write them; other words are text.
bool is_no_finite_number(std::string_view text) {
  std::string_view word = trimmed(text);
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && !std::isfinite(value);
}

/// Why a cell spoils its row; empty where it does not.
std::string fault_of_cell(const CsvCell& cell, bool must_be_positive) {
  const Result<double> number = number_from_text(cell.text);
  if (number) return must_be_positive && !(*number > 0.0) ? "is not positive, expected a positive number" : "";
  if (!must_be_positive && !is_no_finite_number(cell.text)) return "";
  if (trimmed(cell.text).empty()) return "is empty, expected a positive number";
  return number.error().message;
}

std::optional<measurement::RejectedRow> fault_of(const CsvRow& row, const std::vector<std::string>& names,
                                                 std::size_t measured, std::size_t predicted) {
  if (auto fault = fault_of_shape(row, names)) return fault;
  for (std::size_t c = 0; c < names.size(); ++c) {
    const std::string reason = fault_of_cell(row.cells[c], c == measured || c == predicted);
    if (!reason.empty())
      return {{row.cells[c].line, names[c], fmt::format("{} (character {})", reason, row.cells[c].column)}};
  }
  return std::nullopt;
}

/// The numeric cells of the rows that can be used, and what is wrong with the others.
TrendTable read_table(const std::filesystem::path& file, const std::string& measured, const std::string& predicted) {
  const std::string text = read_file(file), source = file.string();
  CsvReader reader(text, source);
  const std::vector<std::string> names = read_heading(reader, source);
  const std::size_t y = position_of(names, measured, source), f = position_of(names, predicted, source);
  TrendTable table;
  for (const std::string& name : names) table.columns.emplace_back(name, NumberColumn{});
  CsvRow row;
  while (reader.next(row)) {
    if (row.blank()) continue;
    if (auto fault = fault_of(row, names, y, f)) {
      table.rejected.push_back(std::move(*fault));
      continue;
    }
    for (std::size_t c = 0; c < names.size(); ++c) {
      const auto number = number_from_text(row.cells[c].text);
      table.columns[c].second.push_back(number ? std::optional<double>(*number) : std::nullopt);
    }
  }
  return table;
}

const NumberColumn& column_named(const TrendTable& table, const std::string& name) {
  return std::find_if(table.columns.begin(), table.columns.end(), [&](const auto& each) { return each.first == name; })
      ->second;
}

/// One column against the residual, over the rows that have both.
struct Pairing {
  std::string name;
  std::vector<double> values, residuals;
  std::vector<std::size_t> rows;
};

}  // namespace

TableTrends table_trends(const std::filesystem::path& file, const std::string& measured, const std::string& predicted,
                         std::uint64_t seed, int permutations) {
  TrendTable table = read_table(file, measured, predicted);
  const NumberColumn& y = column_named(table, measured);
  const NumberColumn& f = column_named(table, predicted);
  std::map<std::size_t, double> residual;  // by row
  for (std::size_t r = 0; r < y.size(); ++r) residual[r] = std::log(*y[r] / *f[r]);
  if (residual.size() < kLeastRows) {
    throw InputError::format("{}: only {} rows have positive numbers in {} and {}, expected at least {}", file.string(),
                             residual.size(), measured, predicted, kLeastRows);
  }
  std::vector<Pairing> pairings;
  for (const auto& [name, values] : table.columns) {
    if (name == measured) continue;
    Pairing pairing{name, {}, {}, {}};
    for (const auto& [row, value] : residual) {
      if (!values[row]) continue;
      pairing.values.push_back(*values[row]);
      pairing.residuals.push_back(value);
      pairing.rows.push_back(row);
    }
    const bool varies = std::any_of(pairing.values.begin(), pairing.values.end(),
                                    [&](double v) { return v != pairing.values.front(); });
    if (pairing.values.size() >= kLeastRows && varies) pairings.push_back(std::move(pairing));
  }
  std::vector<Trend> trends;
  for (const Pairing& p : pairings)
    trends.push_back({p.name, rank_correlation(p.values, p.residuals), 1.0, static_cast<int>(p.rows.size())});
  // Rows are permuted as a whole, so that columns that go together stay together.
  RandomStream random(seed, "table trends");
  std::vector<std::size_t> rows;
  for (const auto& [row, value] : residual) rows.push_back(row);
  std::vector<int> larger(pairings.size(), 0);
  for (int draw = 0; draw < permutations; ++draw) {
    std::vector<std::size_t> shuffled = rows;
    for (std::size_t i = shuffled.size(); i > 1; --i)
      std::swap(shuffled[i - 1], shuffled[random.index(static_cast<int>(i))]);
    std::map<std::size_t, double> moved;
    for (std::size_t i = 0; i < rows.size(); ++i) moved[rows[i]] = residual.at(shuffled[i]);
    double strongest = 0.0;
    for (const Pairing& p : pairings) {
      std::vector<double> residuals;
      for (const std::size_t row : p.rows) residuals.push_back(moved.at(row));
      strongest = std::max(strongest, std::abs(rank_correlation(p.values, residuals)));
    }
    for (std::size_t k = 0; k < pairings.size(); ++k) larger[k] += strongest >= std::abs(trends[k].spearman);
  }
  for (std::size_t k = 0; k < trends.size(); ++k) trends[k].p_family_wise = (1.0 + larger[k]) / (1.0 + permutations);
  std::stable_sort(trends.begin(), trends.end(),
                   [](const Trend& a, const Trend& b) { return std::abs(a.spearman) > std::abs(b.spearman); });
  return {std::move(trends), std::move(table.rejected)};
}

}  // namespace nacre::diagnosis
