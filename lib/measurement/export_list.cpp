#include "measurement/export_list.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "measurement/sweep_blocks.hpp"
#include "measurement/sweep_table.hpp"
#include "measurement/tester_blocks.hpp"
#include "measurement/tester_encoding.hpp"
#include "measurement/tester_export.hpp"
#include "measurement/tester_header.hpp"
#include "measurement/tester_parts.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

/// The course of a series in bars of eight heights.
std::string sparkline_of(const std::vector<double>& values) {
  constexpr std::array<const char*, 8> kBars = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  constexpr std::size_t kWidth = 24;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double range = *most - *least;
  std::string line;
  for (std::size_t i = 0; i < std::min(kWidth, values.size()); ++i) {
    const double value =
        values[i * (values.size() - 1) / std::max<std::size_t>(1, std::min(kWidth, values.size()) - 1)];
    const double height = range > 0.0 ? (value - *least) / range : 0.0;
    line += kBars[static_cast<std::size_t>(std::lround(7.0 * height))];
  }
  return line;
}

/// Rows of a block that belong to a part; all of them where the part was not read.
std::vector<std::size_t> rows_of_part(const TableBlock& block, const TesterPart& part) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < block.rows(); ++row) {
    const int line = static_cast<int>(block.lines[row]) + 1;
    if (part.series.line.empty() || std::binary_search(part.series.line.begin(), part.series.line.end(), line))
      rows.push_back(row);
  }
  return rows;
}

/// Heading, unit and range of a column.
ListedColumn column_of(const TableBlock& block, std::size_t column, const std::vector<std::size_t>& rows,
                       char delimiter) {
  const ColumnName& name = block.columns[column];
  ListedColumn shown{.heading = name.heading, .unit = unit_as_written(name.unit), .quantity = {}, .sparkline = {}};
  const auto values = numbers_of(block, column, rows, delimiter);
  if (!values || values->empty()) return shown;
  const auto [least, most] = std::minmax_element(values->begin(), values->end());
  shown.least = *least;
  shown.most = *most;
  shown.sparkline = sparkline_of(*values);
  return shown;
}

ListedColumn listed(const TableBlock& block, std::size_t column, const std::vector<std::size_t>& rows, char delimiter,
                    const TesterPart& part) {
  const ColumnName& name = block.columns[column];
  ListedColumn shown = column_of(block, column, rows, delimiter);
  if (name.quantity) shown.quantity = to_string(*name.quantity);
  for (const auto& taken : part.series.taken) shown.taken = shown.taken || (taken && taken->heading == name.heading);
  return shown;
}

ListedPart listed(const TesterPart& part, const ExportTables& tables) {
  ListedPart shown{.name = part.name,
                   .line = static_cast<int>(part.heading) + 1,
                   .rows = part.series.line.size(),
                   .columns = {},
                   .decisions = part.series.decisions,
                   .fault = {}};
  if (part.fault) shown.fault = to_string(*part.fault);
  for (const TableBlock& block : tables.blocks) {
    if (block.heading != part.heading) continue;
    const std::vector<std::size_t> rows = rows_of_part(block, part);
    for (const std::size_t i : part.columns) {
      if (!block.columns[i].heading.empty()) shown.columns.push_back(listed(block, i, rows, tables.delimiter, part));
    }
  }
  return shown;
}

/// The columns of a sweep's table.
std::vector<ListedColumn> columns_of_sweep(const TableBlock& block, char delimiter,
                                           const tl::expected<Sweep, ImportFault>& sweep) {
  std::vector<ListedColumn> columns;
  std::vector<std::size_t> rows(block.rows());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  for (std::size_t i = 0; i < block.columns.size(); ++i) {
    const SweepColumn column = recognise_sweep_column(block.columns[i].heading, block.columns[i].unit);
    if (column.name.heading.empty()) continue;
    columns.push_back(column_of(block, i, rows, delimiter));
    columns.back().unit = unit_as_written(column.name.unit);
    if (!column.quantity) continue;
    columns.back().quantity = to_string(*column.quantity);
    const bool is_read = sweep && sweep->column(*column.quantity);
    columns.back().taken = is_read && sweep->column(*column.quantity)->heading == column.name.heading;
  }
  return columns;
}

ListedExport listed_sweep(const ExportTables& tables, const DecodedText& text,
                          const std::vector<std::string_view>& lines, const ColumnChoice& choice,
                          const std::string& file) {
  ListedExport shown{.maker = "table",
                     .encoding = text.encoding,
                     .delimiter = std::string(delimiter_in_words(tables.delimiter)),
                     .parts = {},
                     .notes = {}};
  const auto sweep = sweep_of(tables, lines, choice, file);
  const TableBlock& first = tables.blocks.front();
  ListedPart part{.name = "1",
                  .line = static_cast<int>(first.heading) + 1,
                  .rows = 0,
                  .columns = columns_of_sweep(first, tables.delimiter, sweep),
                  .decisions = {},
                  .fault = {}};
  if (sweep) {
    part.rows = sweep->points.size();
    part.decisions = sweep->decisions;
  } else {
    part.fault = to_string(sweep.error());
  }
  shown.parts.push_back(std::move(part));
  return shown;
}

}  // namespace

tl::expected<ListedExport, ImportFault> list_export(std::string_view bytes, const std::string& file,
                                                    const ColumnChoice& choice) {
  const Result<DecodedText> text = decoded(bytes);
  if (!text) return tl::unexpected(ImportFault{file, 0, "", text.error().message});
  const std::vector<std::string_view> lines = export_lines(text->text);
  const ExportTables sweep = may_be_sweep(choice) ? sweep_tables_of(lines) : ExportTables{};
  if (!sweep.blocks.empty()) return listed_sweep(sweep, *text, lines, choice, file);
  const auto tables = curve_tables_of(lines, file, choice);
  if (!tables) return tl::unexpected(tables.error());
  const ExportParts parts = parts_of(*tables, choice, file);
  ListedExport shown{.maker = maker_of(lines, tables->delimiter),
                     .encoding = text->encoding,
                     .delimiter = std::string(delimiter_in_words(tables->delimiter)),
                     .parts = {},
                     .notes = parts.notes};
  for (const TesterPart& part : parts.parts) shown.parts.push_back(listed(part, *tables));
  return shown;
}

}  // namespace nacre::measurement
