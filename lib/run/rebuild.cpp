#include "run/rebuild.hpp"

#include "base/result.hpp"
#include "run/run_schema.hpp"
#include "runtime/journal.hpp"
#include "store/database_care.hpp"
#include "wire/channels.hpp"

namespace nacre::run {

namespace fs = std::filesystem;

namespace {

fs::path journal_of(const fs::path& run_dir) { return run_dir / "nodes" / "analyser" / "journal.lcm"; }

/// Keeps every message that the journal says was to be kept, in its order.
Rebuilt keep_journal(runtime::LogReader& reader, RunDatabase& database) {
  Rebuilt rebuilt;
  while (const auto record = reader.next()) {
    if (record->channel != runtime::kComputeChannel) continue;
    const auto compute = runtime::unpack(record->data);
    if (!compute || compute->size() != 3 || (*compute)[1] != "store") continue;
    const auto message = runtime::unpack((*compute)[2]);
    if (!message || message->size() != 2) continue;
    const wire::Channel* channel = wire::find_channel((*message)[0]);
    const bool can_be_read = channel != nullptr && channel->validate((*message)[1]).has_value();
    if (can_be_read) database.keep((*message)[0], (*message)[1]);
    ++(can_be_read ? rebuilt.messages : rebuilt.unread);
  }
  rebuilt.torn_bytes = reader.end().torn_bytes;
  return rebuilt;
}

/// Why the file cannot go on; empty when it can.
std::string fault_of(const fs::path& file) {
  if (!fs::exists(file)) return "it is missing";
  if (const auto whole = store::check_database(file); !whole) return whole.error().message;
  const int version = store::schema_version(file);
  if (version == kRunSchemaVersion) return "";
  return fmt::format("it has schema version {}, this program writes {}", version, kRunSchemaVersion);
}

}  // namespace

Rebuilt rebuild_run_database(const fs::path& run_dir) {
  const fs::path file = run_dir / "run.db", anew = run_dir / "run.db.part";
  runtime::LogReader journal(journal_of(run_dir));
  store::remove_database(anew);
  Rebuilt rebuilt;
  try {
    RunDatabase database(anew);
    rebuilt = keep_journal(journal, database);
    database.checkpoint();
  } catch (...) {
    store::remove_database(anew);
    throw;
  }
  // A whole database holds nothing that the whole journal does not; anything else is kept.
  if (fs::exists(file) && (rebuilt.torn_bytes > 0 || !fault_of(file).empty())) store::move_aside(file);
  store::remove_database(file);
  fs::rename(anew, file);
  return rebuilt;
}

std::unique_ptr<RunDatabase> open_run_database(const fs::path& run_dir,
                                               const std::function<void(const std::string&)>& report) {
  const fs::path file = run_dir / "run.db", journal = journal_of(run_dir);
  if (fs::exists(journal) && fs::file_size(journal) > 0) {
    if (const std::string fault = fault_of(file); !fault.empty()) {
      const Rebuilt rebuilt = rebuild_run_database(run_dir);
      report(fmt::format("{}: {}; made anew from {} messages of the journal", file.string(), fault, rebuilt.messages));
    }
  }
  return std::make_unique<RunDatabase>(file);
}

}  // namespace nacre::run
