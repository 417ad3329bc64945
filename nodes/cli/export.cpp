// Part of the command line (command.hpp): nacre export, the messages of a log for other programs.

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <string>

#include "base/counted.hpp"
#include "base/csv.hpp"
#include "base/files.hpp"
#include "base/output_path.hpp"
#include "base/result.hpp"
#include "command.hpp"
#include "csv_tables.hpp"
#include "log_messages.hpp"
#include "output.hpp"
#include "runtime/mcap_writer.hpp"
#include "runtime/version.hpp"

namespace nacre::cli {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  std::string log = "logs/latest";
  bool mcap = false;
  bool csv = false;
  std::string out;
};

/// The log of a run's folder, or the file itself.
fs::path log_file(const std::string& log) {
  std::error_code unreadable;
  if (!fs::is_directory(log, unreadable)) return log;
  const fs::path file = fs::path(log) / "run.lcm";
  if (fs::exists(file, unreadable)) return file;
  throw InputError::format("{}: holds no run.lcm; expected a run's folder, its run.lcm or a node's journal.lcm", log);
}

/// MCAP counts from 1970 without a sign.
std::uint64_t nanoseconds(std::int64_t us) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max() / 1000;
  return 1000 * std::min(static_cast<std::uint64_t>(std::max<std::int64_t>(us, 0)), kMost);
}

class McapFile {
 public:
  explicit McapFile(const fs::path& file) : writer_(file, runtime::version_in_words()) {}

  void add(const LogMessage& message) {
    const std::string json = message.content.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    writer_.add_message({.channel = channel_of(message),
                         .sequence = static_cast<std::uint32_t>(message.sequence),
                         .log_time_ns = nanoseconds(message.logged_us),
                         .publish_time_ns = nanoseconds(message.said_us),
                         .json = json});
  }
  void finish(const Losses& losses) {
    writer_.add_metadata("losses", to_texts(losses));
    writer_.finish();
  }

 private:
  int channel_of(const LogMessage& message) {
    if (const auto known = channels_.find(message.topic); known != channels_.end()) return known->second;
    const std::string schema = "nacre." + std::string(message.channel->type);
    return channels_[message.topic] = writer_.add_channel(message.topic, schema, message.channel->schema().dump());
  }
  runtime::McapWriter writer_;
  std::map<std::string, int> channels_;
};

void write_mcap(LogMessages& messages, const fs::path& file) {
  McapFile mcap(file);
  while (const auto message = messages.next()) mcap.add(*message);
  mcap.finish(messages.losses());
}

void write_csv(LogMessages& messages, const fs::path& folder) {
  CsvTables tables(folder);
  while (const auto message = messages.next()) tables.add(*message);
  tables.finish();
  std::string table = "what,value\n";
  for (const auto& [what, value] : to_texts(messages.losses())) table += csv_cell(what) + "," + csv_cell(value) + "\n";
  write_file_atomically(folder / "losses.csv", table);
}

void say_losses(const Losses& losses, const std::string& log) {
  for (const auto& [channel, count] : losses.unread)
    warn(fmt::format("{}: {}: {} cannot be read; the first, {}", log, channel, counted(count, "message"),
                     losses.why.at(channel)));
  if (losses.never_recorded.value_or(0) > 0)
    warn(fmt::format("{}: {} were said and not recorded", log, counted(*losses.never_recorded, "message")));
}

void prepare_new_folder(const std::string& folder) {
  std::error_code unreadable;
  if (fs::is_directory(folder, unreadable) && !fs::is_empty(folder, unreadable))
    throw InputError::format("{}: holds files; expected a new folder", folder);
  prepare_output_folder(folder);
}

int export_log(const ExportOptions& options) {
  if (options.mcap == options.csv) throw InputError("expected --mcap or --csv: which format is wanted");
  const fs::path log = log_file(options.log);
  LogMessages messages(log);
  const std::string beside = (log.parent_path() / log.stem()).string();
  const std::string out = !options.out.empty() ? options.out : beside + (options.mcap ? ".mcap" : "-csv");
  if (options.mcap) {
    prepare_output_file(out, {log.string()});
    write_mcap(messages, out);
  } else {
    prepare_new_folder(out);
    write_csv(messages, out);
  }
  const Losses& losses = messages.losses();
  say_losses(losses, log.string());
  fmt::print("{} of {}: {}\n", counted(losses.messages, "message"),
             counted(losses.records - losses.own_records, "record"), out);
  return losses.incomplete() ? 1 : 0;
}

}  // namespace

void add_export(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App& command =
      add_command(app, action, "export", "Write the messages of a log for other programs", options, export_log);
  command.add_option("LOG", options->log, "A run's folder, its run.lcm or a node's journal.lcm")->capture_default_str();
  command.add_flag("--mcap", options->mcap,
                   "One MCAP file, which Foxglove and other viewers open: JSON with a schema per message type");
  command.add_flag("--csv", options->csv,
                   "A table per channel, a row per message: times in s since 1970, fields of structs as "
                   "parameters.modulus, lists as JSON in one cell, absent values empty");
  command.add_option("--out", options->out,
                     "File (replaced) or new folder to write; beside LOG when not given: run.mcap, run-csv");
}

}  // namespace nacre::cli
