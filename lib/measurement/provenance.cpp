#include "measurement/provenance.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "base/csv.hpp"
#include "base/files.hpp"
#include "measurement/set_files.hpp"
#include "measurement/tester_text.hpp"

namespace nacre::measurement {
namespace {

constexpr std::array<std::string_view, 49> kHeading = {"specimen",
                                                       "test",
                                                       "file",
                                                       "part",
                                                       "maker",
                                                       "encoding",
                                                       "delimiter",
                                                       "decimal_mark",
                                                       "first_line",
                                                       "last_line",
                                                       "time_column",
                                                       "time_unit",
                                                       "time_not_taken",
                                                       "extension_column",
                                                       "extension_unit",
                                                       "extension_not_taken",
                                                       "force_column",
                                                       "force_unit",
                                                       "force_not_taken",
                                                       "strain_column",
                                                       "strain_unit",
                                                       "strain_not_taken",
                                                       "stress_column",
                                                       "stress_unit",
                                                       "stress_not_taken",
                                                       "frequency_column",
                                                       "frequency_unit",
                                                       "frequency_not_taken",
                                                       "storage_modulus_column",
                                                       "storage_modulus_unit",
                                                       "storage_modulus_not_taken",
                                                       "relaxation_modulus_column",
                                                       "relaxation_modulus_unit",
                                                       "relaxation_modulus_not_taken",
                                                       "amplitude_column",
                                                       "amplitude_unit",
                                                       "amplitude_not_taken",
                                                       "temperature_column",
                                                       "temperature_unit",
                                                       "temperature_not_taken",
                                                       "width_mm",
                                                       "gauge_mm",
                                                       "modulus_pa",
                                                       "modulus_error_pa",
                                                       "toe_strain",
                                                       "toughness_pa",
                                                       "strain_rate_per_s",
                                                       "rate_source",
                                                       "decisions"};

std::string quoted(std::string text) {
  for (char& letter : text) letter = letter == '\n' || letter == '\r' ? ' ' : letter;
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char letter : text) cell += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return cell + "\"";
}

std::vector<std::string> row_of(const ImportedSpecimen& one) {
  std::map<std::string, std::string> cells = one.provenance;
  const auto number = [](double value) { return fmt::format("{:.6g}", value); };
  cells["specimen"] = one.record.specimen;
  cells["test"] = tester::to_string(one.record.test);
  cells["file"] = one.file;
  cells["modulus_pa"] = number(one.test.modulus_pa);
  cells["modulus_error_pa"] = number(one.test.modulus_error_pa);
  cells["toe_strain"] = number(one.test.toe_strain);
  cells["toughness_pa"] = number(one.test.toughness_pa);
  cells["strain_rate_per_s"] = number(one.record.conditions.strain_rate_per_s);
  cells["rate_source"] = one.rate_source;
  cells["decisions"] = fmt::format("{}", fmt::join(one.decisions, "; "));
  std::vector<std::string> row;
  for (const std::string_view name : kHeading) row.push_back(cells[std::string(name)]);
  return row;
}

/// The rows that the set has, under this heading: cells of a column that theirs lacks are empty.
std::vector<std::vector<std::string>> known_rows(const std::filesystem::path& file) {
  std::vector<std::vector<std::string>> rows;
  std::error_code unreadable;
  if (!std::filesystem::exists(file, unreadable)) return rows;
  const std::string text = read_file_up_to(file, kMostTableBytes);
  CsvReader reader(text, file.string());
  CsvRow heading, row;
  if (!reader.next(heading)) return rows;
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < heading.cells.size(); ++i) places.emplace(heading.cells[i].text, i);
  if (!places.contains(std::string(kHeading.front()))) return rows;
  while (reader.next(row)) {
    std::vector<std::string> cells;
    cells.reserve(kHeading.size());
    for (const std::string_view name : kHeading) {
      const auto place = places.find(std::string(name));
      const bool is_there = place != places.end() && place->second < row.cells.size();
      cells.push_back(is_there ? row.cells[place->second].text : "");
    }
    rows.push_back(std::move(cells));
  }
  return rows;
}

}  // namespace

std::map<std::string, std::string> provenance_of_file(const TesterRecord& from, const SheetRow& row) {
  return {{"part", from.part},
          {"maker", from.maker},
          {"encoding", from.encoding},
          {"delimiter", std::string(delimiter_in_words(from.delimiter))},
          {"decimal_mark", std::string(1, from.decimal_mark)},
          {"first_line", fmt::format("{}", from.line.front())},
          {"last_line", fmt::format("{}", from.line.back())},
          {"width_mm", fmt::format("{}", row.width_mm)},
          {"gauge_mm", fmt::format("{}", row.gauge_mm)}};
}

void add_provenance(std::string_view quantity, const std::optional<TakenColumn>& column,
                    std::map<std::string, std::string>& cells) {
  if (!column) return;
  cells[fmt::format("{}_column", quantity)] = column->heading;
  cells[fmt::format("{}_unit", quantity)] = column->unit.empty() ? "none" : unit_as_written(column->unit);
  cells[fmt::format("{}_not_taken", quantity)] = fmt::format("{}", fmt::join(column->not_taken, "; "));
}

void write_provenance(const std::filesystem::path& folder, std::span<const ImportedSpecimen> specimens) {
  std::vector<std::vector<std::string>> rows = known_rows(folder / kProvenanceName);
  for (const ImportedSpecimen& one : specimens) {
    std::erase_if(rows, [&](const auto& row) { return !row.empty() && row.front() == one.record.specimen; });
    rows.push_back(row_of(one));
  }
  std::string text = fmt::format("{}\n", fmt::join(kHeading, ","));
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) text += (i > 0 ? "," : "") + quoted(row[i]);
    text += '\n';
  }
  write_file_atomically(folder / kProvenanceName, text);
}

}  // namespace nacre::measurement
