#pragma once
// One node that the launcher looks after: output, readiness, restarts; or one that runs elsewhere: whether it reports.

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/live_display.hpp"
#include "runtime/process.hpp"
#include "runtime/restart_budget.hpp"
#include "wire/convert.hpp"

namespace nacre::runtime {

/// A node's process over its starts and ends. A node that dies is started again as long as its budget allows; one that
/// ends in order was stopped by a person and stays stopped; one that refuses its input (exit status 2) has failed for
/// good.
class SupervisedNode {
 public:
  using Clock = std::chrono::steady_clock;
  struct Settings {
    std::string name;
    std::vector<std::string> command;  ///< empty: the node runs elsewhere
    std::filesystem::path log_file;    ///< everything it prints, appended
    RestartBudget::Settings restarts;
  };
  enum class State { starting, running, finished, restarting, stopped, failed };

  explicit SupervisedNode(Settings settings);
  ~SupervisedNode();

  /// Starts the process. Throws InputError when the program or the log file cannot be opened.
  void start();
  /// Lines it printed since the last call; they stand in the log file by then.
  std::vector<std::string> take_output();
  /// Takes note of an end and starts again what is due. Returns a sentence for a person when something happened.
  std::optional<std::string> supervise(Clock::time_point now);
  /// A STATUS of this node. Those of an earlier process are ignored.
  void saw(const wire::NodeStatus& status, std::int64_t epoch, Clock::time_point now);
  /// From now on an end is what was asked for: no restarts.
  void expect_end() { end_is_expected_ = true; }
  void signal(int signal) const;

  const std::string& name() const { return settings_.name; }
  State state() const { return state_; }
  bool is_alive() const { return process_ != nullptr; }
  bool runs_elsewhere() const { return settings_.command.empty(); }
  /// Of a node elsewhere: no STATUS for ten seconds, or never.
  bool is_silent(Clock::time_point now) const;
  /// Subscribed and able to play; also true for one that has finished.
  bool is_ready() const { return state_ == State::running || state_ == State::finished; }
  int output() const { return process_ ? process_->output() : -1; }
  NodeView view() const;

 private:
  void open_log();
  void rotate_log();
  std::string take_end(const ProcessEnd& end, Clock::time_point now);
  std::string restart_or_fail(const std::string& how, Clock::time_point now);
  std::string last_words() const;
  std::optional<std::string> listen(Clock::time_point now);

  Settings settings_;
  RestartBudget budget_;
  State state_ = State::stopped;
  std::unique_ptr<ChildProcess> process_;
  std::FILE* log_ = nullptr;
  std::int64_t epoch_ = 0;         ///< of the last STATUS
  std::int64_t epoch_before_ = 0;  ///< of the last STATUS of the process before
  std::optional<Clock::time_point> restart_at_;
  std::string last_line_;
  wire::NodeStatus status_;
  int restarts_ = 0;
  bool end_is_expected_ = false;
  std::optional<Clock::time_point> last_status_at_;
  bool was_silent_ = true;
};

std::string_view to_string(SupervisedNode::State state);

}  // namespace nacre::runtime
