#include "runtime/supervised_node.hpp"

#include <cerrno>
#include <cstring>

#include <fmt/chrono.h>
#include <fmt/ranges.h>

#include "base/result.hpp"
#include "runtime/terminal.hpp"

namespace nacre::runtime {

std::string_view to_string(SupervisedNode::State state) {
  switch (state) {
    case SupervisedNode::State::starting:
      return "starting";
    case SupervisedNode::State::running:
      return "running";
    case SupervisedNode::State::finished:
      return "finished";
    case SupervisedNode::State::restarting:
      return "restarting";
    case SupervisedNode::State::stopped:
      return "stopped";
    case SupervisedNode::State::failed:
      return "failed";
  }
  return "";
}

SupervisedNode::SupervisedNode(Settings settings) : settings_(std::move(settings)), budget_(settings_.restarts) {
  status_.round = -1;
  status_.progress = -1.0;
  status_.eta_s = -1.0;
  if (runs_elsewhere()) state_ = State::starting;
}

SupervisedNode::~SupervisedNode() {
  if (log_ != nullptr) std::fclose(log_);
}

void SupervisedNode::open_log() {
  std::error_code unmade;  // shows as a log that cannot be opened
  std::filesystem::create_directories(settings_.log_file.parent_path(), unmade);
  log_ = std::fopen(settings_.log_file.c_str(), "ae");
  if (log_ == nullptr) {
    throw InputError::format("{}: cannot be written: {}", settings_.log_file.string(), std::strerror(errno));
  }
}

/// output.log becomes output.log.1, that one output.log.2, the oldest goes: a node that talks for weeks fills no disk.
void SupervisedNode::rotate_log() {
  constexpr long kLargest = 5 << 20;
  constexpr int kOldFiles = 3;
  if (std::ftell(log_) < kLargest) return;
  const auto old = [&](int number) { return fmt::format("{}.{}", settings_.log_file.string(), number); };
  std::error_code ignored;  // a file that cannot be renamed is written on
  for (int number = kOldFiles - 1; number >= 1; --number)
    std::filesystem::rename(old(number), old(number + 1), ignored);
  std::filesystem::rename(settings_.log_file, old(1), ignored);
  std::FILE* const full = log_;
  try {
    open_log();
    std::fclose(full);
  } catch (const InputError&) {
    log_ = full;
  }
}

void SupervisedNode::start() {
  if (log_ == nullptr) open_log();
  print_line(log_, fmt::format("# {:%Y-%m-%dT%H:%M:%SZ} {}", fmt::gmtime(std::time(nullptr)),
                               fmt::join(settings_.command, " ")));
  std::fflush(log_);
  epoch_before_ = epoch_;
  process_ = std::make_unique<ChildProcess>(settings_.command);
  state_ = State::starting;
}

std::vector<std::string> SupervisedNode::take_output() {
  if (!process_) return {};
  std::vector<std::string> lines = process_->read_lines();
  for (const std::string& line : lines) {
    print_line(log_, line);
    if (!line.empty()) last_line_ = line;
  }
  if (!lines.empty()) {
    std::fflush(log_);
    rotate_log();
  }
  return lines;
}

std::optional<std::string> SupervisedNode::supervise(Clock::time_point now) {
  if (runs_elsewhere()) return listen(now);
  if (process_) {
    const std::optional<ProcessEnd> end = process_->poll_end();
    if (!end) return std::nullopt;
    return take_end(*end, now);
  }
  if (!restart_at_ || now < *restart_at_ || end_is_expected_) return std::nullopt;
  restart_at_.reset();
  ++restarts_;
  try {
    start();
  } catch (const InputError& problem) {  // its program is being replaced, no process or file is left: that may pass
    return restart_or_fail(problem.what(), now);
  }
  return fmt::format("{} started again", name());
}

std::string SupervisedNode::take_end(const ProcessEnd& end, Clock::time_point now) {
  take_output();
  process_.reset();
  print_line(log_, "# ended: " + end.in_words());
  std::fflush(log_);
  constexpr int kBadInput = 2;
  if (end_is_expected_ || end.orderly()) {
    state_ = State::stopped;
    return fmt::format("{} stopped ({})", name(), end.in_words());
  }
  if (end.exit_status == kBadInput) {
    state_ = State::failed;
    return fmt::format("{} cannot work ({}){}; all it printed: {}", name(), end.in_words(), last_words(),
                       settings_.log_file.string());
  }
  return restart_or_fail(end.in_words(), now);
}

/// After a death, or a start that did not succeed.
std::string SupervisedNode::restart_or_fail(const std::string& how, Clock::time_point now) {
  const std::optional<Clock::duration> wait = budget_.take(now);
  if (!wait) {
    state_ = State::failed;
    return fmt::format("{} died too often ({}){}; it is not started again; all it printed: {}", name(), how,
                       last_words(), settings_.log_file.string());
  }
  state_ = State::restarting;
  restart_at_ = now + *wait;
  return fmt::format("{} died ({}){}; it is started again in {:g} s", name(), how, last_words(),
                     std::chrono::duration<double>(*wait).count());
}

std::string SupervisedNode::last_words() const {
  constexpr int kShownColumns = 300;
  return last_line_.empty() ? "" : fmt::format("; it last said: {}", fitted(last_line_, kShownColumns));
}

bool SupervisedNode::is_silent(Clock::time_point now) const {
  constexpr auto kPatience = std::chrono::seconds(10);  // a node reports twice a second
  return runs_elsewhere() && (!last_status_at_ || now - *last_status_at_ > kPatience);
}

/// A node elsewhere that falls silent, or reports again.
std::optional<std::string> SupervisedNode::listen(Clock::time_point now) {
  const bool is_silent_now = is_silent(now);
  if (is_silent_now == was_silent_ || state_ == State::finished) return std::nullopt;
  was_silent_ = is_silent_now;
  if (is_silent_now) return fmt::format("{} does not report any more; the game waits for it", name());
  return fmt::format("{} reports from elsewhere", name());
}

void SupervisedNode::saw(const wire::NodeStatus& status, std::int64_t epoch, Clock::time_point now) {
  // A late STATUS of a process that has died. Not told by the time in it: clocks may be set.
  if (process_ && epoch_before_ != 0 && epoch == epoch_before_) return;
  if (!process_ && state_ != State::stopped && !runs_elsewhere()) return;
  last_status_at_ = now;
  epoch_ = epoch;
  status_ = status;
  // A stopped node that reports again runs elsewhere: started by hand, perhaps on another machine.
  if (status.finished) {
    state_ = State::finished;
  } else if (status.ready) {
    state_ = State::running;
  }
}

void SupervisedNode::signal(int signal) const {
  if (process_) process_->signal_group(signal);
}

NodeView SupervisedNode::view() const {
  return {.node = name(),
          .state = std::string(to_string(state_)),
          .phase = status_.phase,
          .round = status_.round,
          .progress = status_.progress,
          .eta_s = state_ == State::running ? status_.eta_s : -1.0,
          .restarts = restarts_,
          .problem = status_.last_problem};
}

}  // namespace nacre::runtime
