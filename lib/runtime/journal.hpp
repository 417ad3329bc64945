#pragma once
// A node's journal: everything that went into its core and came out of it, in the LCM log format.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "runtime/folder_lock.hpp"
#include "runtime/log_file.hpp"
#include "runtime/node_core.hpp"

namespace nacre::runtime {

// Channels of the journal's own records. Inputs from the bus stand under their own channel with the bytes that came.
inline constexpr std::string_view kJournalChannel =
    "~journal";  ///< identity of the journal, boot it was begun in: begins it, follows a cut or another boot
inline constexpr std::string_view kTickChannel = "~tick";  ///< input: utime
inline constexpr std::string_view kWorkChannel = "~work";  ///< input: id, result
inline constexpr std::string_view kOutPrefix =
    "~out/";  ///< output message, channel appended: payload with blank header
inline constexpr std::string_view kComputeChannel = "~compute";  ///< output: id, kind, journaled_spec()
inline constexpr std::string_view kAckedChannel = "~acked";      ///< hash, node, identity of that node's journal

/// Fields of a record in one string, closed by a checksum.
std::string pack(const std::vector<std::string>& fields);
/// The fields again; the error says that the record is damaged.
Result<std::vector<std::string>> unpack(std::string_view record);

/// The spec, or its hash (Compute::by_hash).
std::string journaled_spec(const Compute& compute);

/// Name that the machine's kernel gives itself at each start; empty where it has none.
std::string boot_of_machine();

/// What a person can do about a damaged journal, to follow its name.
inline constexpr std::string_view kRemedyForDamage =
    "Move it away, or put the one of a backup (nacre backup) in its place, and go on: the node begins anew, or where "
    "the backup ends, and the other nodes send again what it lacks. What people brought is to be brought again "
    "(nacre inject, approve, review)";

/// A node's journal, opened for going on: locked against a second process, torn tail cut off.
class Journal {
 public:
  /// Opens FOLDER/journal.lcm. Throws InputError: locked by another process, damaged in the middle, not writable;
  /// NoSpace on a full disk.
  /// `boot`: since when what is written is in the machine's memory at least.
  static std::unique_ptr<Journal> open(const std::filesystem::path& folder, std::int64_t now_utime,
                                       const std::string& boot = boot_of_machine());
  /// To read what stands in it: LogReader(journal.path()).
  const std::filesystem::path& path() const { return path_; }
  /// When this journal was begun, microseconds since 1970; a new number after a torn tail was cut off and after each
  /// start of the machine, which may have lost the tail whole.
  std::int64_t identity() const { return identity_; }
  /// Its length, which is where the next record will start.
  std::int64_t bytes() const { return bytes_; }
  /// The message that the core sent, from its record at byte `place`. Throws InputError where there is none.
  Message sent_message(std::int64_t place) const;
  /// What was cut off, as a sentence; empty when nothing was.
  const std::string& warning() const { return warning_; }
  /// Adds a record and flushes; `to_disk` also waits for the disk.
  Result<void> append(std::int64_t utime, std::string_view channel, std::string_view data, bool to_disk = false);

 private:
  Journal() = default;
  std::optional<FolderLock> lock_;  // let go of last
  std::unique_ptr<LogWriter> writer_;
  std::filesystem::path path_;
  std::int64_t identity_ = 0;
  std::int64_t bytes_ = 0;
  std::string warning_;
};

}  // namespace nacre::runtime
