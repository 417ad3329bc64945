#include "runtime/recorder.hpp"

#include <bit>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "base/no_space.hpp"
#include "runtime/journal.hpp"
#include "runtime/latest_state.hpp"
#include "runtime/log_file.hpp"
#include "runtime/log_pieces.hpp"
#include "runtime/sequence.hpp"

namespace nacre::runtime {
namespace {

std::int64_t bytes_in_log(std::string_view channel, std::string_view data) {
  return kRecordHeaderSize + static_cast<std::int64_t>(channel.size() + data.size());
}

/// How the last piece of a log goes on.
struct LastPiece {
  std::int64_t records = 0;
  std::int64_t own_bytes = 0;  ///< beside the repeated state
};

/// Cuts a torn tail off an existing piece, and takes the state that it ends with where one is wanted.
LastPiece mend(const std::filesystem::path& path, LatestState* latest) {
  LastPiece last;
  if (!std::filesystem::exists(path)) return last;
  LogReader reader(path);
  std::int64_t repeated_until = -1;
  while (true) {
    try {
      const auto record = reader.next();
      if (!record) break;
      ++last.records;
      if (latest != nullptr) latest->take(record->channel, record->data);
      if (record->channel == kPieceChannel) repeated_until = record->number + repeated_behind(*record);
      if (record->number > repeated_until) last.own_bytes += bytes_in_log(record->channel, record->data);
    } catch (const InputError&) {
      reader.resync();  // damaged in the middle: what stands behind it is still worth keeping
    }
  }
  std::error_code ignored;
  if (reader.end().torn_bytes > 0)
    std::filesystem::resize_file(path, static_cast<std::uintmax_t>(reader.end().sound_bytes), ignored);
  return last;
}

}  // namespace

struct Recorder::State {
  RecorderOptions options;
  std::unique_ptr<LogWriter> writer;
  std::unique_ptr<Bus> bus;
  SequenceCounter sequences;
  RecorderCounters counters;
  LatestState latest;
  int piece = 1;
  std::int64_t own_bytes = 0;  ///< of the piece, beside the repeated state
  std::int64_t next_flush = 0;
  bool unflushed = false;

  void report(LogLevel level, const std::string& text) const {
    if (options.report) options.report(level, text);
  }

  /// The next piece comes under its name with the whole state in it: whoever is killed before leaves the last one.
  Result<void> begin_piece() {
    if (const Result<void> flushed = writer->flush(); !flushed) return flushed;
    const std::filesystem::path file = piece_of(options.log, piece + 1), part = file.string() + ".part";
    std::error_code problem;
    std::filesystem::remove(part, problem);
    auto next = std::make_unique<LogWriter>(part);
    const std::vector<LatestState::Kept> state = latest.messages();
    Result<void> written =
        next->append(now_utime(), kPieceChannel, pack({std::to_string(piece + 1), std::to_string(state.size())}));
    for (const LatestState::Kept& each : state)
      if (written) written = next->append(now_utime(), each.channel, each.bytes);
    if (written) written = next->flush();
    if (!written) return written;
    std::filesystem::rename(part, file, problem);
    if (problem) return fail("{}: cannot be made: {}", file.string(), problem.message());
    writer = std::move(next);
    ++piece;
    own_bytes = 0;
    return {};
  }

  Result<void> record(const Datagram& datagram) {
    if (datagram.channel.empty()) {  // no reader of logs knows such an event: the rest would be lost with it
      if (counters.unnamed++ == 0)
        report(LogLevel::warning, "a message without a channel is not recorded; further ones are not told of");
      return {};
    }
    if (options.most_bytes > 0 && own_bytes >= options.most_bytes)
      if (const Result<void> begun = begin_piece(); !begun) return begun;
    const Result<void> written = writer->append(now_utime(), datagram.channel, datagram.bytes);
    if (!written) return written;
    own_bytes += bytes_in_log(datagram.channel, datagram.bytes);
    if (options.most_bytes > 0) latest.take(datagram.channel, datagram.bytes);
    unflushed = true;
    ++counters.messages;
    counters.bytes += datagram.bytes.size();
    const Result<wire::Blanked> blanked = wire::blank_header(datagram.channel, datagram.bytes);
    if (!blanked) return {};  // recorded all the same: that it was on the bus is what the log is for
    sequences.count(datagram.channel, blanked->header);
    if (sequences.lost() > counters.lost && std::has_single_bit(static_cast<std::uint64_t>(sequences.lost()))) {
      report(LogLevel::warning,
             fmt::format("{} messages so far are missing in {}", sequences.lost(), options.log.string()));
    }
    counters.lost = sequences.lost();
    return {};
  }
};

Recorder::Recorder(RecorderOptions options) : state_(std::make_unique<State>()) {
  state_->options = std::move(options);
  const std::filesystem::path& log = state_->options.log;
  std::error_code ignored;  // the writer says why the file cannot be made
  if (log.has_parent_path()) std::filesystem::create_directories(log.parent_path(), ignored);
  const std::vector<std::filesystem::path> pieces = pieces_of(log);
  const LastPiece last = mend(pieces.back(), state_->options.most_bytes > 0 ? &state_->latest : nullptr);
  state_->piece = static_cast<int>(pieces.size());
  state_->own_bytes = last.own_bytes;
  state_->writer = std::make_unique<LogWriter>(pieces.back(), last.records);
  BusOptions bus;
  bus.url = state_->options.url;
  bus.node = "recorder";
  Result<std::unique_ptr<Bus>> opened = Bus::open(std::move(bus));
  if (!opened) throw InputError(opened.error().message);
  state_->bus = std::move(*opened);
  if (const Result<void> listening = state_->bus->subscribe({}); !listening)
    throw InputError(listening.error().message);
}

Recorder::~Recorder() {
  if (state_ && state_->writer) [[maybe_unused]]
    const Result<void> flushed = state_->writer->flush();
}

Result<void> Recorder::pump(int timeout_ms) {
  Result<void> written;
  state_->bus->receive_raw(timeout_ms, [&](const Datagram& datagram) {
    if (written) written = state_->record(datagram);
  });
  const std::int64_t now = steady_us();
  if (written && state_->unflushed && now >= state_->next_flush) {
    written = state_->writer->flush();
    state_->unflushed = false;
    state_->next_flush = now + static_cast<std::int64_t>(1e6 * state_->options.flush_every_s);
  }
  return written;
}

RecorderCounters Recorder::counters() const { return state_->counters; }

int run_recorder(const RecorderOptions& options, const std::function<bool()>& is_over) {
  const auto say = [&](LogLevel level, const std::string& text) {
    if (options.report) {
      options.report(level, text);
    } else {
      std::fprintf(stderr, "recorder: %s\n", text.c_str());
    }
  };
  try {
    Recorder recorder(options);
    if (options.ready) options.ready();
    int turns_left = 4;  // for what is still on its way when it is over
    while (!is_over() || turns_left-- > 0) {
      if (const Result<void> written = recorder.pump(50); !written) {
        say(LogLevel::error, written.error().message);
        return 1;
      }
    }
    const RecorderCounters counters = recorder.counters();
    say(LogLevel::info,
        fmt::format("recorded {} messages, {} bytes, {} lost", counters.messages, counters.bytes, counters.lost));
    return 0;
  } catch (const NoSpace& problem) {
    say(LogLevel::error, problem.what());
    return 1;
  } catch (const InputError& problem) {
    say(LogLevel::error, problem.what());
    return 2;
  }
}

}  // namespace nacre::runtime
