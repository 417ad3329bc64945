#include "runtime/log_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <lcm/lcm.h>

#include "base/no_space.hpp"

namespace nacre::runtime {
namespace {

// A record: magic, number (8 bytes), utime (8), channel length (4), data length (4), channel, data; big-endian.
constexpr std::string_view kMagic = "\xED\xA1\xDA\x01";
constexpr std::int64_t kLongestChannel = 1000;

std::int64_t read_integer(std::string_view bytes, std::int64_t offset, int size) {
  std::uint64_t value = 0;
  for (int i = 0; i < size; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[offset + i]);
  return value;
}

}  // namespace

struct LogReader::State {
  std::filesystem::path path;
  std::string_view bytes;  ///< the file, mapped
  std::int64_t position = 0;

  ~State() {
    if (!bytes.empty()) ::munmap(const_cast<char*>(bytes.data()), bytes.size());
  }

  std::int64_t size() const { return bytes.size(); }

  /// Where the record at `offset` ends; nothing when there is no whole record.
  std::optional<std::int64_t> end_of_record(std::int64_t offset) const {
    if (size() - offset < kRecordHeaderSize) return std::nullopt;
    if (bytes.substr(static_cast<std::size_t>(offset), kMagic.size()) != kMagic) return std::nullopt;
    const std::int64_t channel_length = read_integer(bytes, offset + 20, 4);
    const std::int64_t data_length = read_integer(bytes, offset + 24, 4);
    if (channel_length < 1 || channel_length > kLongestChannel) return std::nullopt;
    const std::int64_t end = offset + kRecordHeaderSize + channel_length + data_length;
    if (end > size()) return std::nullopt;
    return end;
  }

  /// The next place behind `offset` where a whole record starts, followed by the end, another record or a torn one.
  std::optional<std::int64_t> next_sound(std::int64_t offset) const {
    for (std::size_t at = bytes.find(kMagic, static_cast<std::size_t>(offset) + 1); at != std::string_view::npos;
         at = bytes.find(kMagic, at + 1)) {
      const auto end = end_of_record(at);
      if (!end) continue;
      const std::string_view behind = bytes.substr(static_cast<std::size_t>(*end), kMagic.size());
      if (kMagic.starts_with(behind)) return static_cast<std::int64_t>(at);
    }
    return std::nullopt;
  }
};

LogReader::LogReader(const std::filesystem::path& path, std::int64_t from) : state_(std::make_unique<State>()) {
  state_->path = path;
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (fd < 0 || ::fstat(fd, &status) != 0 || !S_ISREG(status.st_mode)) {
    const int reason = fd >= 0 && errno == 0 ? EINVAL : errno;
    if (fd >= 0) ::close(fd);
    throw InputError::format("{}: cannot be read as a log: {}", path.string(), std::strerror(reason));
  }
  const std::size_t size = status.st_size;
  void* mapped = size > 0 ? ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd, 0) : nullptr;
  const int reason = errno;
  ::close(fd);
  if (mapped == MAP_FAILED) throw InputError::format("{}: cannot be read: {}", path.string(), std::strerror(reason));
  if (mapped) state_->bytes = {static_cast<const char*>(mapped), size};
  // Bytes that begin as no record does and hold none are no log that was torn: nobody may take them for one and cut
  // them off. Zeros are what some file systems leave after a power failure.
  const bool begins_as_log = kMagic.starts_with(state_->bytes.substr(0, kMagic.size()));
  const bool is_blank = state_->bytes.find_first_not_of('\0') == std::string_view::npos;
  if (!begins_as_log && !is_blank && !state_->next_sound(0))
    throw InputError::format("{}: no LCM log: it holds no record", path.string());
  state_->position = std::min(from, state_->size());
}

LogReader::~LogReader() = default;

std::optional<LogRecord> LogReader::next() {
  const std::int64_t offset = state_->position;
  const auto end = state_->end_of_record(offset);
  if (!end) {
    if (const auto sound = state_->next_sound(offset); offset < state_->size() && sound) {
      throw InputError::format("{}: damaged at byte {}; the next sound record starts at byte {}", state_->path.string(),
                               offset, *sound);
    }
    return std::nullopt;
  }
  const std::int64_t channel_length = read_integer(state_->bytes, offset + 20, 4);
  const auto part = [&](std::int64_t from, std::int64_t to) {
    return std::string(state_->bytes.substr(static_cast<std::size_t>(from), static_cast<std::size_t>(to - from)));
  };
  state_->position = *end;
  const std::int64_t data = offset + kRecordHeaderSize + channel_length;
  return LogRecord{read_integer(state_->bytes, offset + 4, 8), read_integer(state_->bytes, offset + 12, 8),
                   part(offset + kRecordHeaderSize, data), part(data, *end), offset};
}

void LogReader::resync() { state_->position = state_->next_sound(state_->position).value_or(state_->size()); }

LogEnd LogReader::end() const { return {state_->position, state_->size() - state_->position}; }

struct LogWriter::State {
  std::filesystem::path path;
  lcm_eventlog_t* log = nullptr;
  int reason = 0;  ///< why it broke

  Result<void> broke(int why) {
    reason = why;
    return fail("{}: cannot be written: {}", path.string(), std::strerror(why));
  }
};

LogWriter::LogWriter(const std::filesystem::path& path, std::int64_t next_number) : state_(std::make_unique<State>()) {
  state_->path = path;
  state_->log = lcm_eventlog_create(path.c_str(), "a");
  if (!state_->log) {
    const int reason = errno;
    refuse_write(fmt::format("{}: cannot be opened for writing: {}", path.string(), std::strerror(reason)), reason);
  }
  state_->log->eventcount = next_number;  // the library would start again at 0
}

LogWriter::~LogWriter() {
  if (state_->log) lcm_eventlog_destroy(state_->log);
}

Result<void> LogWriter::append(std::int64_t utime, std::string_view channel, std::string_view data) {
  if (state_->reason != 0) return fail("{}: not written after an earlier failure", state_->path.string());
  std::string name(channel);
  lcm_eventlog_event_t event{};
  event.timestamp = utime;
  event.channellen = static_cast<std::int32_t>(name.size());
  event.datalen = static_cast<std::int32_t>(data.size());
  event.channel = name.data();
  event.data = const_cast<char*>(data.data());
  if (lcm_eventlog_write_event(state_->log, &event) != 0) return state_->broke(errno);
  return {};
}

Result<void> LogWriter::flush() {
  if (std::fflush(state_->log->f) != 0) return state_->broke(errno);
  return {};
}

int LogWriter::reason() const { return state_->reason; }

Result<void> LogWriter::sync() {
  const Result<void> flushed = flush();
  if (!flushed) return flushed;
  if (::fdatasync(::fileno(state_->log->f)) != 0) return state_->broke(errno);
  return {};
}

}  // namespace nacre::runtime
