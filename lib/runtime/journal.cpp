#include "runtime/journal.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "base/file_aside.hpp"
#include "base/files.hpp"
#include "base/hash.hpp"
#include "base/no_space.hpp"
#include "runtime/log_file.hpp"

namespace nacre::runtime {
namespace {

void append_u32(std::string& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(value >> shift));
}

std::uint32_t read_u32(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes.substr(0, 4)) value = value << 8 | static_cast<std::uint8_t>(byte);
  return value;
}

constexpr std::size_t kHashSize = 32;

/// What a journal is found like.
struct Found {
  std::int64_t records = 0;
  std::int64_t identity = 0;
  std::string boot;     ///< that the identity was begun in; empty in journals of before it was written down
  std::string warning;  ///< what was cut off
};

void take_identity(const std::filesystem::path& path, const LogRecord& record, Found& found) {
  const auto fields = unpack(record.data);
  if (!fields || fields->empty()) {
    throw InputError::format("{}: record {} at byte {} is damaged", path.string(), record.number, record.offset);
  }
  found.identity = std::stoll(fields->front());
  found.boot = fields->size() > 1 ? fields->at(1) : "";
}

/// Walks through the journal and cuts its torn tail off.
Found read_and_mend(const std::filesystem::path& path) {
  Found found;
  if (!std::filesystem::exists(path)) return found;
  LogReader reader(path);
  try {
    for (; const auto record = reader.next(); ++found.records) {
      if (record->channel == kJournalChannel) take_identity(path, *record, found);
    }
  } catch (const InputError& damage) {
    throw InputError::format("{}. {}", damage.what(), kRemedyForDamage);
  }
  const LogEnd end = reader.end();
  if (end.torn_bytes == 0) return found;
  if (::truncate(path.c_str(), end.sound_bytes) != 0) {
    throw InputError::format("{}: its torn tail cannot be cut off: {}", path.string(), std::strerror(errno));
  }
  found.warning =
      fmt::format("{}: the last {} bytes were a record that was being written when the node ended; cut off at byte {}",
                  path.string(), end.torn_bytes, end.sound_bytes);
  return found;
}

}  // namespace

std::string pack(const std::vector<std::string>& fields) {
  std::string record;
  for (const std::string& field : fields) {
    append_u32(record, static_cast<std::uint32_t>(field.size()));
    record += field;
  }
  return record + content_hash(record);
}

Result<std::vector<std::string>> unpack(std::string_view record) {
  if (record.size() < kHashSize) return fail("a record of {} bytes is too short", record.size());
  std::string_view rest = record.substr(0, record.size() - kHashSize);
  if (content_hash(rest) != record.substr(rest.size())) return fail("the record's checksum does not fit its bytes");
  std::vector<std::string> fields;
  while (!rest.empty()) {
    if (rest.size() < 4 || read_u32(rest) > rest.size() - 4) return fail("the record's lengths do not fit");
    const std::uint32_t length = read_u32(rest);
    fields.emplace_back(rest.substr(4, length));
    rest.remove_prefix(4 + length);
  }
  return fields;
}

std::string journaled_spec(const Compute& compute) {
  return compute.by_hash ? content_hash(compute.spec) : compute.spec;
}

std::string boot_of_machine() {
  std::string boot;
  std::ifstream file("/proc/sys/kernel/random/boot_id");
  std::getline(file, boot);
  return boot;
}

std::unique_ptr<Journal> Journal::open(const std::filesystem::path& folder, std::int64_t now_utime,
                                       const std::string& boot) {
  make_folder(folder);
  std::unique_ptr<Journal> journal(new Journal());
  journal->lock_.emplace(folder);
  journal->path_ = folder / "journal.lcm";
  const Found found = read_and_mend(journal->path_);
  journal->warning_ = found.warning;
  journal->identity_ = found.identity;
  journal->writer_ = std::make_unique<LogWriter>(journal->path_, found.records);
  journal->bytes_ = std::filesystem::file_size(journal->path_);
  const auto expect_written = [&](const Result<void>& written) {
    if (!written) refuse_write(written.error().message, journal->writer_->reason());
  };
  // What the process before wrote may not be on disk yet, and this one will call it known.
  expect_written(journal->writer_->sync());
  if (journal->identity_ == 0 || !journal->warning_.empty() || found.boot != boot) {
    // What a torn tail held may have been acknowledged (a disk that lies, a machine that failed): begin a new identity.
    // So may what a machine lost that went down: most records are not on disk when they are acknowledged, and the rest
    // may end with a whole one.
    journal->identity_ = now_utime;
    expect_written(journal->append(now_utime, kJournalChannel, pack({std::to_string(now_utime), boot}), true));
    sync_folder(folder);
  }
  return journal;
}

Message Journal::sent_message(std::int64_t place) const {
  std::optional<LogRecord> record = LogReader(path_, place).next();
  if (!record || !record->channel.starts_with(kOutPrefix)) {
    throw InputError::format("{}: no message that was sent at byte {}: changed while the node used it", path_.string(),
                             place);
  }
  return {record->channel.substr(kOutPrefix.size()), std::move(record->data)};
}

Result<void> Journal::append(std::int64_t utime, std::string_view channel, std::string_view data, bool to_disk) {
  Result<void> written = writer_->append(utime, channel, data);
  if (written) written = writer_->flush();
  if (written && to_disk) written = writer_->sync();
  if (written) bytes_ += kRecordHeaderSize + static_cast<std::int64_t>(channel.size() + data.size());
  return written;
}

}  // namespace nacre::runtime
