#include "runtime/recorder.hpp"

#include <bit>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "base/no_space.hpp"
#include "runtime/log_file.hpp"
#include "runtime/sequence.hpp"

namespace nacre::runtime {
namespace {

/// Cuts a torn tail off an existing log; returns the number of records in it.
std::int64_t mend(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return 0;
  LogReader reader(path);
  std::int64_t records = 0;
  while (true) {
    try {
      if (!reader.next()) break;
      ++records;
    } catch (const InputError&) {
      reader.resync();  // damaged in the middle: what stands behind it is still worth keeping
    }
  }
  std::error_code ignored;
  if (reader.end().torn_bytes > 0)
    std::filesystem::resize_file(path, static_cast<std::uintmax_t>(reader.end().sound_bytes), ignored);
  return records;
}

}  // namespace

struct Recorder::State {
  RecorderOptions options;
  std::unique_ptr<LogWriter> writer;
  std::unique_ptr<Bus> bus;
  SequenceCounter sequences;
  RecorderCounters counters;
  std::int64_t next_flush = 0;
  bool unflushed = false;

  void report(LogLevel level, const std::string& text) const {
    if (options.report) options.report(level, text);
  }

  Result<void> record(const Datagram& datagram) {
    if (datagram.channel.empty()) {  // no reader of logs knows such an event: the rest would be lost with it
      if (counters.unnamed++ == 0)
        report(LogLevel::warning, "a message without a channel is not recorded; further ones are not told of");
      return {};
    }
    const Result<void> written = writer->append(now_utime(), datagram.channel, datagram.bytes);
    if (!written) return written;
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
  state_->writer = std::make_unique<LogWriter>(log, mend(log));
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
