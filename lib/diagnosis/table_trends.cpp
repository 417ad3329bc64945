#include "diagnosis/table_trends.hpp"

#include <algorithm>
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

using Column = std::vector<std::optional<double>>;

/// The numeric cells of every column, by name, in the order of the header.
std::vector<std::pair<std::string, Column>> numeric_columns(const std::filesystem::path& table) {
  const std::string text = read_file(table);
  CsvReader reader(text, table.string());
  CsvRow row;
  if (!reader.next(row)) throw InputError::format("{}: is empty, expected a header", table.string());
  std::vector<std::pair<std::string, Column>> columns;
  for (const CsvCell& cell : row.cells) columns.emplace_back(std::string(trimmed(cell.text)), Column{});
  while (reader.next(row)) {
    if (row.blank() || !row.fault.empty()) continue;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto number = c < row.cells.size() ? number_from_text(row.cells[c].text) : Result<double>(fail("no cell"));
      columns[c].second.push_back(number ? std::optional<double>(*number) : std::nullopt);
    }
  }
  return columns;
}

const Column& column_named(const std::vector<std::pair<std::string, Column>>& columns, const std::string& name,
                           const std::filesystem::path& table) {
  for (const auto& [each, values] : columns) {
    if (each == name) return values;
  }
  throw InputError::format("{}: line 1: has no column {}", table.string(), name);
}

/// One column against the residual, over the rows that have both.
struct Pairing {
  std::string name;
  std::vector<double> values, residuals;
  std::vector<std::size_t> rows;
};

}  // namespace

std::vector<Trend> table_trends(const std::filesystem::path& table, const std::string& measured,
                                const std::string& predicted, std::uint64_t seed, int permutations) {
  const auto columns = numeric_columns(table);
  const Column& y = column_named(columns, measured, table);
  const Column& f = column_named(columns, predicted, table);
  std::map<std::size_t, double> residual;  // by row
  for (std::size_t r = 0; r < y.size(); ++r) {
    if (y[r] && f[r] && *y[r] > 0.0 && *f[r] > 0.0) residual[r] = std::log(*y[r] / *f[r]);
  }
  if (residual.size() < kLeastRows) {
    throw InputError::format("{}: only {} rows have positive numbers in {} and {}, expected at least {}",
                             table.string(), residual.size(), measured, predicted, kLeastRows);
  }
  std::vector<Pairing> pairings;
  for (const auto& [name, values] : columns) {
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
      std::swap(shuffled[i - 1], shuffled[static_cast<std::size_t>(random.index(static_cast<int>(i)))]);
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
  return trends;
}

}  // namespace nacre::diagnosis
