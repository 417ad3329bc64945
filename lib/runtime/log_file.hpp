#pragma once
// Logs in the LCM format (readable by lcm-logplayer and lcm-spy): records with time, channel and bytes.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace nacre::runtime {

/// What a record takes in the file beside its channel and data.
inline constexpr std::int64_t kRecordHeaderSize = 28;

/// One record of a log.
struct LogRecord {
  std::int64_t number = 0;
  std::int64_t utime = 0;
  std::string channel;
  std::string data;
  std::int64_t offset = 0;  ///< where it starts in the file
};

/// How a log ends.
struct LogEnd {
  std::int64_t sound_bytes = 0;  ///< up to the end of the last whole record
  std::int64_t torn_bytes = 0;   ///< behind it: a record that was being written
};

/// Reads an LCM log one record at a time. A torn tail ends the log; damage in the middle is an error.
class LogReader {
 public:
  /// Begins at byte `from`, where a record starts. Throws InputError when the file cannot be read or is no log; an
  /// empty one is one.
  explicit LogReader(const std::filesystem::path& path, std::int64_t from = 0);
  ~LogReader();
  /// The next record; nothing at the end. Throws InputError naming file and offset when the log is damaged in the
  /// middle, and where it goes on (see resync).
  std::optional<LogRecord> next();
  /// After damage: goes on at the next sound record.
  void resync();
  LogEnd end() const;  ///< after next() returned nothing

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes an LCM log.
class LogWriter {
 public:
  /// Appends to `path` (created when absent), numbering from `next_number`. Throws InputError, NoSpace on a full disk.
  LogWriter(const std::filesystem::path& path, std::int64_t next_number = 0);
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;
  /// Adds a record; it may stay in memory until flush(). After a failure nothing is written any more: what follows a
  /// torn record would be lost.
  Result<void> append(std::int64_t utime, std::string_view channel, std::string_view data);
  /// Hands everything to the operating system: it survives this process.
  Result<void> flush();
  /// Waits until the disk has it: it survives the machine.
  Result<void> sync();
  /// The errno of what failed; 0 when nothing has.
  int reason() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nacre::runtime
