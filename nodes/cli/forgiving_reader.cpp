#include "forgiving_reader.hpp"

#include "base/result.hpp"
#include "output.hpp"

namespace nacre::cli {

namespace {

/// LogReader opens folders' names too late for a helpful error.
const std::filesystem::path& checked(const std::filesystem::path& log) {
  std::error_code unreadable;
  if (std::filesystem::is_directory(log, unreadable))
    throw InputError::format("{}: is a folder, expected a log: RUN/run.lcm, or a node's journal.lcm", log.string());
  return log;
}

}  // namespace

ForgivingReader::ForgivingReader(const std::filesystem::path& log) : log_(checked(log)), reader_(log_) {}

std::optional<runtime::LogRecord> ForgivingReader::next() {
  while (true) {
    try {
      auto record = reader_.next();
      if (!record) note_end();
      return record;
    } catch (const InputError& damage) {
      warn(damage.what());
      ++damaged_places_;
      reader_.resync();
    }
  }
}

void ForgivingReader::note_end() {
  const runtime::LogEnd end = reader_.end();
  torn_bytes_ = end.torn_bytes;
  if (torn_bytes_ == 0) return;
  warn(fmt::format("{}: ends in a torn record, {} bytes from byte {}: it is being written, or was when that ended",
                   reader_.path().string(), end.torn_bytes, end.sound_bytes));
}

}  // namespace nacre::cli
