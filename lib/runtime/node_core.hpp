#pragma once
// What a node is: a pure step from inputs to outputs. The shell (node_shell.hpp) owns LCM, time, files and threads.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace nacre::runtime {

/// A message without its header: `payload` is the LCM encoding of the type of `channel` with a default header_t. The
/// shell stamps the header on sending and blanks it on receiving, so that equal contents are equal bytes with an equal
/// hash.
struct Message {
  std::string channel;
  std::string payload;
  bool operator==(const Message&) const = default;
};

/// A periodic call, for cores that ask for one. Most decisions need none.
struct Tick {
  std::int64_t utime = 0;
};

/// The result of long work that the core asked for with Compute.
struct WorkDone {
  std::string id;
  std::string result;
};

using Input = std::variant<Message, Tick, WorkDone>;

/// Long work: a pure function of its spec, run by the shell on a worker thread. `kind` selects the function among those
/// that the node registered; `id` is unique within the run.
struct Compute {
  std::string id;
  std::string kind;
  std::string spec;
  /// Of a spec that is long and that nobody else reads: the journal holds its hash, the core makes it again.
  bool by_hash = false;
  bool operator==(const Compute&) const = default;
};

enum class LogLevel { debug, info, warning, error };

/// A line for the node's text log.
struct LogLine {
  LogLevel level = LogLevel::info;
  std::string text;
  bool operator==(const LogLine&) const = default;
};

/// Everything a step causes, in order within each kind.
struct Outputs {
  std::vector<Message> messages;
  std::vector<Compute> computes;
  std::vector<LogLine> log;
  /// Why the message of this step changes nothing, for whoever sent it; empty where it may change something.
  std::string refusal;
  void append(Outputs&& other);
};

/// What a node is doing, for people (STATUS). Never used in decisions. A phase begins with "waiting" where the node
/// waits for another one, and is "idle" where it has nothing to do.
struct Status {
  std::string phase = "waiting";
  int round = 0;
  double progress = -1.0;  ///< 0..1 of the phase, -1 unknown
  bool finished = false;
};

/// The pure core of a node. It never logs, sleeps, reads a clock or a file, or draws unseeded random numbers: its
/// outputs are a function of the inputs so far. Messages that it cannot decode or validate are returned as a warning
/// and change nothing.
class NodeCore {
 public:
  virtual ~NodeCore() = default;
  virtual Outputs step(const Input& input) = 0;
  virtual Status status() const = 0;
  /// Messages of `channel` as they were sent, to be heard again by a program that came later (ASK): orders that are
  /// not complete, say. Nothing of channels on which nothing stays open.
  virtual std::vector<Message> open(std::string_view channel) const {
    (void)channel;
    return {};
  }
  /// Seconds between ticks; 0 for a core that needs none (most).
  virtual double tick_period_s() const { return 0.0; }
};

/// A function for one kind of long work. Deterministic, thread-safe, and free to use all it needs to read from `spec`.
using WorkFunction = std::function<std::string(const std::string& spec)>;

}  // namespace nacre::runtime
