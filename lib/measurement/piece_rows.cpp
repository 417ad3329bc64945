#include "measurement/piece_rows.hpp"

#include <fmt/format.h>

#include "measurement/limits.hpp"
#include "measurement/piece.hpp"

namespace nacre::measurement {

ImportedSpecimen common_of_piece(const SheetRow& row, const TesterRecord& from) {
  ImportedSpecimen common{.record = row.record,
                          .file = row.file,
                          .line = row.line,
                          .maker = from.maker,
                          .extension_column = "",
                          .gauge_mm = row.gauge_mm,
                          .decisions = from.decisions};
  for (const auto& [name, text] : from.header) common.record.other_columns.try_emplace(name, text);
  common.record.other_columns.try_emplace(std::string(kSampleColumn), row.record.specimen);
  return common;
}

tl::expected<std::vector<ImportedSpecimen>, ImportFault> rows_of_piece(const SheetRow& row,
                                                                       std::vector<ImportedSpecimen> rows,
                                                                       const std::vector<ImportDoubt>& doubts,
                                                                       const std::string& sheet,
                                                                       std::vector<std::string>& warnings) {
  for (const ImportDoubt& doubt : doubts)
    warnings.push_back(fmt::format("specimen {}: {}", row.record.specimen, doubt.text));
  const std::size_t width = fmt::format("{}", rows.size()).size();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].doubts = doubts;
    rows[i].record.specimen += fmt::format("-{:0{}}", i + 1, width);
  }
  if (const std::string& last = rows.back().record.specimen; last.size() > kLongestName)
    return tl::unexpected(ImportFault{
        sheet, row.line, "specimen",
        fmt::format("the names of a table's rows have {} bytes, expected at most {}", last.size(), kLongestName)});
  return rows;
}

}  // namespace nacre::measurement
