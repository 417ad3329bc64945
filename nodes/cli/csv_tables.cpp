#include "csv_tables.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/csv.hpp"
#include "base/files.hpp"

namespace nacre::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostWaiting = 1 << 16;  ///< bytes of a table that are not yet written

std::string text_of(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// Adds a column for every member of `schema` that is no struct: JSON pointers, `/parameters/modulus`.
void add_columns(const Json& schema, const std::string& place, std::vector<std::string>& columns) {
  for (const auto& [name, member] : schema["properties"].items()) {
    if (member["type"] == "object") {
      add_columns(member, place + "/" + name, columns);
    } else if (place + name != "/headerutime") {  // publish_time_s
      columns.push_back(place + "/" + name);
    }
  }
}

std::string heading_of(std::string place) {
  std::replace(place.begin(), place.end(), '/', '.');
  return place.substr(1);
}

std::string cell_of(const Json& message, const std::string& place) {
  const Json::json_pointer pointer(place);
  if (!message.contains(pointer)) return {};
  const Json& value = message[pointer];
  return csv_cell(value.is_string() ? value.get<std::string>() : text_of(value));
}

/// Seconds with all digits that microseconds have.
std::string seconds(std::int64_t us) {
  const std::int64_t size = us < 0 ? -(us + 1) + 1 : us;
  return fmt::format("{}{}.{:06}", us < 0 ? "-" : "", size / 1'000'000, size % 1'000'000);
}

}  // namespace

CsvTables::Table& CsvTables::table_of(const LogMessage& message) {
  std::unique_ptr<Table>& table = tables_[message.topic];
  if (table) return *table;
  const std::filesystem::path file = folder_ / (message.topic + ".csv");
  make_folder(file.parent_path());
  table.reset(new Table{.columns = {}, .file = FileAside(file), .waiting = "log_time_s,publish_time_s"});
  add_columns(message.channel->schema(), "", table->columns);
  for (const std::string& column : table->columns) table->waiting += "," + heading_of(column);
  table->waiting += "\n";
  return *table;
}

void CsvTables::add(const LogMessage& message) {
  Table& table = table_of(message);
  table.waiting += seconds(message.logged_us) + "," + seconds(message.said_us);
  for (const std::string& column : table.columns) table.waiting += "," + cell_of(message.content, column);
  table.waiting += "\n";
  if (table.waiting.size() < kMostWaiting) return;
  table.file.append(table.waiting);
  table.waiting.clear();
}

void CsvTables::finish() {
  for (auto& [topic, table] : tables_) {
    table->file.append(table->waiting);
    table->file.keep();
  }
  tables_.clear();
}

}  // namespace nacre::cli
