#pragma once
// Feeds a journal through a core: how a node restarts, and how a recorded game is checked.

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "base/result.hpp"
#include "runtime/log_file.hpp"
#include "runtime/node_core.hpp"

namespace nacre::runtime {

/// Steps a core through the records of its journal and compares what it sends with what it sent. Whoever needs more of
/// the records sets the functions.
class Fold {
 public:
  explicit Fold(NodeCore& core) : core_(core) {}

  std::function<void(const Message&)> on_message_input;                    ///< inputs from the bus
  std::function<void(const Message&, const std::string& why)> on_refused;  ///< an input from the bus
  /// Journaled outputs, in order; `place`: byte at which the record starts.
  std::function<void(const Message&, std::int64_t place)> on_output;
  std::function<void(const std::string& hash, const std::string& node, std::int64_t journal)> on_acknowledged;
  /// Called with the work that a journaled result belongs to; an error stops the fold.
  std::function<Result<void>(const Compute&, const std::string& result)> on_work_done;

  /// One record. The error names the record and the field in which core and journal differ, or says what is damaged.
  Result<void> feed(const LogRecord& record);

  /// What the last input causes and the journal does not hold (the node was stopped between): to be done now.
  Outputs take_unfinished();

  /// Work asked for without a result, by id in the order asked.
  std::vector<Compute> open_work() const;

  std::int64_t inputs = 0, outputs = 0, computes = 0;

 private:
  Result<void> input(const LogRecord& record, const Input& input);
  Result<void> output(const LogRecord& record);
  Result<void> compute(const LogRecord& record);
  Result<void> work_done(const LogRecord& record, const std::vector<std::string>& fields);

  NodeCore& core_;
  std::deque<Message> expected_messages_;
  std::deque<Compute> expected_computes_;
  std::vector<LogLine> last_log_;
  std::vector<Compute> asked_;
  std::map<std::string, std::size_t> asked_index_;
  std::set<std::string> done_;
};

}  // namespace nacre::runtime
