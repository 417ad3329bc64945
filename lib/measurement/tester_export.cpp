#include "measurement/tester_export.hpp"

#include <fmt/format.h>

#include <span>
#include <utility>

#include "measurement/sweep_blocks.hpp"
#include "measurement/tester_blocks.hpp"
#include "measurement/tester_encoding.hpp"
#include "measurement/tester_header.hpp"
#include "measurement/tester_parts.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

TesterRecord record_of(TesterPart part, const ExportTables& tables) {
  TesterRecord record;
  ColumnSeries& series = part.series;
  record.delimiter = tables.delimiter;
  record.decimal_mark = series.decimal_mark;
  record.part = std::move(part.name);
  record.time_s = std::move(series.of(Quantity::time));
  record.extension_mm = std::move(series.of(Quantity::extension));
  record.force_n = std::move(series.of(Quantity::force));
  record.strain = std::move(series.of(Quantity::strain));
  record.stress_pa = std::move(series.of(Quantity::stress));
  record.line = std::move(series.line);
  record.taken = std::move(series.taken);
  record.strains = std::move(series.strains);
  record.decisions = std::move(series.decisions);
  record.warnings = std::move(series.warnings);
  record.fault = std::move(part.fault);
  return record;
}

/// A record of each piece, in the order in which they begin; `common` has a sweep without points.
std::vector<TesterRecord> records_of_pieces(const std::vector<SweepPoint>& points, const TesterRecord& common) {
  std::vector<TesterRecord> records;
  std::map<std::string, std::size_t> places;
  for (const SweepPoint& point : points) {
    const auto [place, is_new] = places.try_emplace(point.sample, records.size());
    if (is_new) {
      records.push_back(common);
      records.back().part = point.sample.empty() ? "1" : point.sample;
    }
    records[place->second].line.push_back(point.line);
    records[place->second].sweep->points.push_back(point);
  }
  return records;
}

tl::expected<std::vector<TesterRecord>, ImportFault> sweep_records(const ExportTables& tables, const DecodedText& text,
                                                                   const std::vector<std::string_view>& lines,
                                                                   const ColumnChoice& choice,
                                                                   const std::string& file) {
  auto sweep = sweep_of(tables, lines, choice, file);
  if (!sweep) return tl::unexpected(sweep.error());
  const std::vector<SweepPoint> points = std::exchange(sweep->points, {});
  TesterRecord common;
  common.maker = "table";
  common.encoding = text.encoding;
  common.delimiter = tables.delimiter;
  common.decimal_mark = sweep->decimal_mark;
  common.header = header_of(std::span(lines).first(tables.blocks.front().heading), tables.delimiter);
  common.decisions = sweep->decisions;
  common.warnings = sweep->warnings;
  common.sweep = std::move(*sweep);
  return records_of_pieces(points, common);
}

}  // namespace

bool may_be_sweep(const ColumnChoice& choice) {
  return choice.extension.empty() && choice.force.empty() && choice.strain.empty() && choice.stress.empty();
}

tl::expected<ExportTables, ImportFault> curve_tables_of(const std::vector<std::string_view>& lines,
                                                        const std::string& file, const ColumnChoice& choice) {
  auto tables = tables_of(lines, file, choice);
  if (tables || !may_be_sweep(choice)) return tables;
  if (const auto fault = fault_of_no_frequency(lines, file)) return tl::unexpected(*fault);
  return tables;
}

std::string to_string(const ImportFault& fault) {
  std::string place = fault.file;
  if (fault.line > 0) place += fmt::format(":{}", fault.line);
  if (!fault.column.empty()) place += fmt::format(": {}", fault.column);
  return fmt::format("{}: {}", place, fault.reason);
}

tl::expected<std::vector<TesterRecord>, ImportFault> read_tester_export(std::string_view bytes, const std::string& file,
                                                                        const ColumnChoice& choice) {
  const std::vector<std::string> hints = {choice.extension, choice.force, choice.time, choice.strain, choice.stress};
  const Result<DecodedText> text = decoded(bytes, hints);
  if (!text) return tl::unexpected(ImportFault{file, 0, "", text.error().message});
  const std::vector<std::string_view> lines = export_lines(text->text);
  const ExportTables sweep = may_be_sweep(choice) ? sweep_tables_of(lines) : ExportTables{};
  if (!sweep.blocks.empty()) return sweep_records(sweep, *text, lines, choice, file);
  const auto tables = curve_tables_of(lines, file, choice);
  if (!tables) return tl::unexpected(tables.error());
  ExportParts found = parts_of(*tables, choice, file);
  if (found.parts.empty())
    return tl::unexpected(ImportFault{file, 0, "", "holds no numbers, expected rows of extension and force"});
  if (found.parts.size() == 1 && found.parts.front().fault) return tl::unexpected(*found.parts.front().fault);
  const TableBlock& first = tables->blocks.front();
  const std::string maker = maker_of(lines, tables->delimiter);
  const auto header = header_of(std::span(lines).first(first.heading), tables->delimiter);
  std::vector<TesterRecord> records;
  for (TesterPart& part : found.parts) {
    records.push_back(record_of(std::move(part), *tables));
    TesterRecord& record = records.back();
    record.maker = maker;
    record.encoding = text->encoding;
    record.header = header;
    record.is_bare = first.is_bare;
    if (first.is_bare)
      record.warnings.push_back(fmt::format("{}: has no heading, {}extension in mm, force in N are assumed", file,
                                            record.column(Quantity::time) ? "time in s, " : ""));
    record.decisions.insert(record.decisions.end(), found.notes.begin(), found.notes.end());
  }
  return records;
}

}  // namespace nacre::measurement
