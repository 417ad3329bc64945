#include "runtime/node_shell.hpp"

#include <sys/eventfd.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <utility>

#include "base/no_space.hpp"
#include "base/result.hpp"
#include "runtime/bus.hpp"
#include "runtime/fold.hpp"
#include "runtime/journal.hpp"
#include "runtime/pending_requests.hpp"
#include "runtime/recent_problem.hpp"
#include "runtime/reliable.hpp"
#include "runtime/text_log.hpp"
#include "runtime/work_pool.hpp"
#include "wire/channels.hpp"
#include "wire/convert.hpp"

namespace nacre::runtime {
namespace {

constexpr std::int64_t kStatusPeriodUs = 500'000;
constexpr std::int64_t kLongestWaitUs = 500'000;

/// Something that ends the node with exit status 1; the journal holds all that was acknowledged.
class NodeFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

std::atomic<bool> stop_requested = false;  // by a signal, which a worker may receive
static_assert(std::atomic<bool>::is_always_lock_free);
int wake_fd = -1;  // an eventfd: signals and workers end the wait for messages

void wake() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(wake_fd, &one, sizeof one);
}

extern "C" void request_stop(int) {
  const int saved = errno;
  stop_requested = true;
  wake();
  errno = saved;
}

void prepare_process(bool follow_parent) {
  turn_write_signals_into_errors();
  wake_fd = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  struct sigaction action {};
  action.sa_handler = request_stop;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  if (follow_parent) ::prctl(PR_SET_PDEATHSIG, SIGTERM);
}

/// Time left, from the progress since the phase began.
class Eta {
 public:
  double seconds_left(const Status& status, std::int64_t now) {
    if (status.phase != phase_ || status.round != round_) {
      phase_ = status.phase;
      round_ = status.round;
      start_ = now;
      start_progress_ = status.progress;
    }
    const double gained = status.progress - start_progress_;
    if (status.progress < 0.0 || start_progress_ < 0.0 || gained <= 0.0) return -1.0;
    return 1e-6 * static_cast<double>(now - start_) * (1.0 - status.progress) / gained;
  }

 private:
  std::string phase_;
  int round_ = -1;
  std::int64_t start_ = 0;
  double start_progress_ = -1.0;
};

class NodeShell {
 public:
  NodeShell(NodeOptions options, NodeCore& core, const MakeExecutor& make_executor, TextLog& log)
      : options_(std::move(options)), core_(core), make_executor_(make_executor), log_(log) {}

  void start() {
    journal_ = Journal::open(options_.node_dir(), now_utime());
    if (!journal_->warning().empty()) problem(LogLevel::warning, journal_->warning());
    // Not before: an executor may tidy files of the run, which are this process' own only now.
    executor_ = make_executor_(wake);
    open_bus();
    resume();
    next_status_ = steady_us();
    tick_period_us_ = static_cast<std::int64_t>(1e6 * core_.tick_period_s());
    next_tick_ = steady_us() + tick_period_us_;
  }

  void run() {
    while (!stop_requested) {
      bus_->receive(
          wait_ms(), [this](const Received& received) { handle(received); }, wake_fd);
      std::uint64_t count = 0;
      [[maybe_unused]] const ssize_t drained = ::read(wake_fd, &count, sizeof count);
      for (const LogLine& line : executor_->take_log()) {
        line.level >= LogLevel::warning ? problem(line.level, line.text) : log_.write(line.level, line.text);
      }
      for (FinishedWork& finished : executor_->finished()) take_result(std::move(finished));
      if (tick_period_us_ > 0 && steady_us() >= next_tick_) tick();
      send_due();
      if (steady_us() >= next_status_) publish_status();
    }
  }

  bool busy() const { return executor_ && executor_->pending() > 0; }

 private:
  void open_bus() {
    BusOptions bus;
    bus.url = options_.url.empty() ? bus_url(options_.port, options_.lan) : options_.url;
    bus.node = options_.node;
    bus.run_id = options_.run_id;
    bus.epoch = options_.epoch;
    bus.faults = faults_from_environment();
    bus.report = [this](LogLevel level, const std::string& text) { problem(level, text); };
    Result<std::unique_ptr<Bus>> opened = Bus::open(std::move(bus));
    if (!opened) throw InputError(opened.error().message);
    bus_ = std::move(*opened);
    std::vector<std::string> channels;
    for (const wire::Channel& channel : wire::channels()) {
      if (wire::listens(channel, options_.node)) channels.emplace_back(channel.name);
    }
    if (const Result<void> listening = bus_->subscribe(channels); !listening)
      throw InputError(listening.error().message);
  }

  /// Restart is replay: the journal is folded through the core, what it sent without an acknowledgement is offered
  /// again, and work without a result is started again.
  void resume() {
    Fold fold(core_);
    fold.on_message_input = [this](const Message& m) { inbox_.remember(wire::message_hash(m.channel, m.payload)); };
    fold.on_refused = [this](const Message& m, const std::string& why) {
      inbox_.refuse(wire::message_hash(m.channel, m.payload), why);
    };
    fold.on_output = [this](const Message& m, std::int64_t place) { offer(m, place); };
    fold.on_acknowledged = [this](const std::string& hash, const std::string& node, std::int64_t journal) {
      outbox_.acknowledge(hash, node, 0, journal);
    };
    LogReader reader(journal_->path());
    while (const auto record = reader.next()) {
      if (const Result<void> agreed = fold.feed(*record); !agreed) {
        throw InputError::format(
            "{}: cannot be resumed: {}. If another version of nacre wrote it, use that one (manifest.json). {}",
            journal_->path().string(), agreed.error().message, kRemedyForDamage);
      }
    }
    for (Compute& compute : fold.open_work()) executor_->start(std::move(compute));
    carry_out(fold.take_unfinished());
    if (fold.inputs > 0) {
      log_.write(LogLevel::info, fmt::format("resumed from a journal of {} inputs; {} messages and {} works are open",
                                             fold.inputs, outbox_.unacknowledged(), executor_->pending()));
    }
  }

  void write_down(std::string_view channel, std::string_view data, bool to_disk = false) {
    const Result<void> written = journal_->append(now_utime(), channel, data, to_disk);
    if (written) return;
    throw NodeFailure(
        fmt::format("{}. The node stops; nothing that it acknowledged is lost. Make room and start it again",
                    written.error().message));
  }

  void problem(LogLevel level, const std::string& text) {
    problem_.note(text, steady_us());
    log_.write(level, text);
  }

  // ---- Inputs ----

  void handle(const Received& received) {
    const std::string& channel = received.message.channel;
    if (channel == "STATUS") return handle_status(received);
    if (received.header.node == options_.node) return;
    if (channel == "ACK") return handle_ack(received);
    if (channel == "ASK") return handle_ask(received);
    const wire::Channel& known = *wire::find_channel(channel);
    if (!wire::is_meant_for(known, received.message.payload, options_.node)) return;
    const std::string hash = wire::message_hash(channel, received.message.payload);
    if (wire::is_response(channel)) {
      const std::string request_id = wire::request_id_of(channel, received.message.payload);
      if (!requests_.asked(request_id)) return handle_unrequested(request_id, hash);
    }
    if (!inbox_.is_new(hash)) {
      ++inbox_.duplicates;
      repeat_responses(received);
    } else {
      write_down(channel, received.bytes, known.synced);
      inbox_.remember(hash);
      Outputs outputs = core_.step(received.message);
      if (!outputs.refusal.empty()) inbox_.refuse(hash, outputs.refusal);
      carry_out(std::move(outputs));
    }
    inbox_.owe(hash, steady_us());
  }

  void handle_unrequested(const std::string& request_id, const std::string& hash) {
    const ResponseFate fate = requests_.fate_of(request_id, core_.status().finished);
    if (fate == ResponseFate::dismiss) inbox_.owe(hash, steady_us());
  }

  void handle_status(const Received& received) {
    if (received.header.node == options_.node) {
      if (received.header.epoch == bus_->epoch()) {
        received_own_status_ = true;
      } else if (received.header.epoch > bus_->epoch()) {
        problem(LogLevel::error, fmt::format("another process calls itself {} in this run", options_.node));
      }
      return;
    }
    const auto status = wire::read<wire::NodeStatus>(received.message.payload);
    if (status) outbox_.saw(received.header.node, received.header.epoch, status->journal);
  }

  void handle_ack(const Received& received) {
    const auto ack = wire::read<wire::Ack>(received.message.payload);
    if (!ack) return;
    const wire::Header& from = received.header;
    for (const std::string& hash : ack->hashes) {
      if (!outbox_.acknowledge(hash, from.node, from.epoch, ack->journal)) continue;
      write_down(kAckedChannel, pack({hash, from.node, std::to_string(ack->journal)}));
    }
  }

  /// Nobody acknowledges what is said again: who asked asks again where something got lost. No decision, no journal.
  void handle_ask(const Received& received) {
    const auto ask = wire::read<wire::Ask>(received.message.payload);
    if (!ask) return;
    for (const Message& message : core_.open(ask->channel)) bus_->publish(message);
  }

  /// A requester that lost its journal sends again a request that has its responses already.
  void repeat_responses(const Received& received) {
    if (received.message.channel != "SIMULATE") return;
    const std::string request_id = wire::request_id_of("SIMULATE", received.message.payload);
    outbox_.respond_again(request_id, received.header.node, received.header.epoch);
  }

  void take_result(FinishedWork finished) {
    const Compute& compute = finished.compute;
    if (!finished.result) {
      throw NodeFailure(
          fmt::format("the work {} ({}) failed: {}", compute.id, compute.kind, finished.result.error().message));
    }
    write_down(kWorkChannel, pack({compute.id, *finished.result}));
    step(WorkDone{compute.id, *finished.result});
  }

  void tick() {
    const std::int64_t now = now_utime();
    next_tick_ = steady_us() + tick_period_us_;
    write_down(kTickChannel, pack({std::to_string(now)}));
    step(Tick{now});
  }

  // ---- Outputs ----

  void step(const Input& input) { carry_out(core_.step(input)); }

  void carry_out(Outputs outputs) {
    for (const LogLine& line : outputs.log) log_.write(line.level, line.text);
    for (const Message& message : outputs.messages) {
      expect_sound(message);
      const std::int64_t place = journal_->bytes();
      write_down(std::string(kOutPrefix) + message.channel, message.payload);
      offer(message, place);
    }
    for (Compute& compute : outputs.computes) {
      if (!executor_->knows(compute.kind)) {
        throw NodeFailure(fmt::format("the core asks for work of the unknown kind {} ({})", compute.kind, compute.id));
      }
      write_down(kComputeChannel, pack({compute.id, compute.kind, journaled_spec(compute)}));
      executor_->start(std::move(compute));
    }
  }

  /// A core that sends something invalid has a bug: every receiver would drop it and the game would stand still without
  /// a word.
  void expect_sound(const Message& message) const {
    const Result<void> sound = wire::check_outgoing(message.channel, message.payload);
    if (!sound)
      throw NodeFailure(fmt::format("the core's message on {} is invalid: {}", message.channel, sound.error().message));
  }

  /// `place`: of the message's record in the journal, whose bytes are read again for each sending. A run sends more
  /// than a node's memory should hold, and any of it may be wanted again by a node that lost its journal.
  void offer(const Message& message, std::int64_t place) {
    if (message.channel == "SIMULATE") requests_.ask(wire::request_id_of(message.channel, message.payload));
    outbox_.offer(parcel_of(message, place, options_.participants, options_.node));
  }

  void send_due() {
    const std::int64_t now = steady_us();
    for (const std::int64_t place : outbox_.due(now)) bus_->publish(journal_->sent_message(place));
    if (std::vector<std::string> hashes = inbox_.due(now); !hashes.empty()) {
      wire::Ack ack;
      ack.journal = journal_->identity();
      for (const std::string& hash : hashes)
        if (const std::string* why = inbox_.refusal_of(hash)) ack.refused.push_back({hash, *why});
      ack.hashes = std::move(hashes);
      bus_->publish({"ACK", wire::write(ack)});
    }
  }

  void publish_status() {
    const std::int64_t now = steady_us();
    next_status_ = now + kStatusPeriodUs;
    const Status status = core_.status();
    const BusCounters& bus = bus_->counters();
    wire::NodeStatus message;
    message.journal = journal_->identity();
    message.ready = received_own_status_;
    message.unacknowledged = outbox_.unacknowledged();
    message.computing = executor_->pending();
    message.finished = status.finished && message.unacknowledged == 0 && message.computing == 0;
    message.phase = status.phase;
    message.round = status.round;
    message.progress = std::clamp(status.progress, -1.0, 1.0);
    message.eta_s = eta_.seconds_left(status, now);
    message.received = inbox_.size();
    message.published = bus.published;
    message.retries = outbox_.retries();
    message.duplicates = inbox_.duplicates;
    message.rejected = bus.rejected();
    message.lost = bus.lost;
    message.dropped = dropped_by_system();
    message.queued = bus_->queued();
    message.owed = static_cast<std::int32_t>(inbox_.owed());
    message.journal_bytes = journal_->bytes();
    message.work = executor_->standing();
    message.last_problem = problem_.shown(now);
    bus_->publish({"STATUS", wire::write(message)});
  }

  int wait_ms() const {
    const std::int64_t now = steady_us();
    std::int64_t until = std::min(now + kLongestWaitUs, next_status_);
    if (tick_period_us_ > 0) until = std::min(until, next_tick_);
    if (const auto due = outbox_.next_due()) until = std::min(until, *due);
    if (const auto due = inbox_.next_due()) until = std::min(until, *due);
    return static_cast<int>(std::max<std::int64_t>(0, (until - now + 999) / 1000));
  }

  NodeOptions options_;
  NodeCore& core_;
  const MakeExecutor& make_executor_;
  TextLog& log_;
  std::unique_ptr<Journal> journal_;
  std::unique_ptr<Bus> bus_;
  Outbox outbox_;
  Inbox inbox_;
  std::unique_ptr<Executor> executor_;
  PendingRequests requests_;
  Eta eta_;
  RecentProblem problem_;
  bool received_own_status_ = false;
  std::int64_t next_status_ = 0;
  std::int64_t next_tick_ = 0;
  std::int64_t tick_period_us_ = 0;
};

/// Ends the process without waiting for work that is still running: it has no effects, and a restart does it again.
[[noreturn]] void leave_at_once(int status, TextLog& log) {
  log.flush();
  std::fflush(nullptr);
  ::_exit(status);
}

}  // namespace

void turn_write_signals_into_errors() {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files
  std::signal(SIGPIPE, SIG_IGN);  // a reader of our standard error that went away
}

int run_node(NodeOptions options, std::unique_ptr<NodeCore> core, std::map<std::string, WorkFunction> work,
             const MakeExecutor& executor) {
  prepare_process(options.follow_parent);
  if (options.run_id.empty()) options.run_id = options.run_dir.filename();
  std::error_code ignored;  // Journal::open says why the folder cannot be created
  std::filesystem::create_directories(options.node_dir(), ignored);
  TextLog log(options.node, options.node_dir());
  int status = 0;
  bool busy = false;
  try {
    const MakeExecutor threads = [&](std::function<void()> wake_up) {
      return std::make_unique<WorkPool>(std::move(work), options.threads, std::move(wake_up));
    };
    NodeShell shell(options, *core, executor ? executor : threads, log);
    try {
      shell.start();
      log.write(LogLevel::info, fmt::format("{} of run {} listens", options.node, options.run_id));
      shell.run();
      log.write(LogLevel::info, "stopped in order");
    } catch (const NoSpace& problem) {
      log.write(LogLevel::error, problem.what());
      status = 1;
    } catch (const InputError& problem) {
      log.write(LogLevel::error, problem.what());
      status = 2;
    } catch (const std::exception& problem) {
      log.write(LogLevel::error, problem.what());
      status = 1;
    }
    busy = shell.busy();
  } catch (const std::exception& problem) {
    log.write(LogLevel::error, problem.what());
    status = 1;
  }
  if (busy) leave_at_once(status, log);
  return status;
}

}  // namespace nacre::runtime
