#include "runtime/replay.hpp"

#include <deque>
#include <set>
#include <utility>

#include "base/result.hpp"
#include "runtime/content_difference.hpp"
#include "runtime/fold.hpp"
#include "runtime/journal.hpp"
#include "runtime/log_pieces.hpp"
#include "wire/channels.hpp"
#include "wire/header.hpp"

namespace nacre::runtime {
namespace {

Result<std::string> do_work(const std::map<std::string, WorkFunction>& work, const Compute& compute) {
  const auto function = work.find(compute.kind);
  if (function == work.end()) return fail("work {}: there is no function for its kind {}", compute.id, compute.kind);
  try {
    return function->second(compute.spec);
  } catch (const std::exception& problem) {
    return fail("work {} ({}) failed: {}", compute.id, compute.kind, problem.what());
  }
}

/// Recomputes a journaled result and compares.
Result<void> compare_work(const std::map<std::string, WorkFunction>& work, const Compute& compute,
                          const std::string& recorded) {
  const Result<std::string> now = do_work(work, compute);
  if (!now) return tl::unexpected(now.error());
  if (*now == recorded) return {};
  return fail("the result of work {} ({}) differs, recorded against now: {}", compute.id, compute.kind,
              content_difference(recorded, *now));
}

InputError nothing_to_replay(const std::filesystem::path& log) {
  return InputError::format("{}: holds no whole record: there is nothing to replay", log.string());
}

/// What is played from a bus log: the core's side of the game.
class BusReplay {
 public:
  BusReplay(const std::string& node, NodeCore& core, const std::map<std::string, WorkFunction>& work,
            ReplayReport& report)
      : node_(node), core_(core), work_(work), report_(report) {}

  void feed(const LogRecord& record) {
    const wire::Channel* channel = wire::find_channel(record.channel);
    if (!channel || !channel->reliable) return;
    if (wire::fingerprint_of(record.data) != channel->fingerprint) {
      ++of_another_version_;
      return;
    }
    const Result<wire::Blanked> blanked = wire::blank_header(record.channel, record.data);
    if (!blanked || !channel->validate(blanked->payload)) return;  // a receiver would have dropped it
    const std::string hash = wire::message_hash(record.channel, blanked->payload);
    if (blanked->header.node == node_) {
      sent_.emplace(hash, record.channel);
    } else if (wire::is_meant_for(*channel, blanked->payload, node_) && received_.insert(hash).second) {
      step(Message{record.channel, blanked->payload});
    }
  }

  void compare() {
    if (of_another_version_ > 0)
      differs(fmt::format("messages of another version of nacre (manifest.json names it), which cannot be read: {}",
                          of_another_version_));
    for (const auto& [hash, channel] : sent_) {
      if (!now_.count(hash)) differs(fmt::format("a message on {} was sent then and is not sent now", channel));
    }
    for (const auto& [hash, channel] : now_) {
      if (!sent_.count(hash))
        differs(fmt::format("a message on {} is sent now and was not sent then (or was not recorded)", channel));
    }
    report_.outputs = sent_.size();
    report_.equal = report_.difference.empty();
  }

 private:
  void differs(const std::string& sentence) {
    if (report_.difference.empty()) report_.difference = sentence;
  }

  void step(const Input& first) {
    std::deque<Input> inputs{first};
    while (!inputs.empty()) {
      ++report_.inputs;
      Outputs outputs = core_.step(inputs.front());
      inputs.pop_front();
      for (const Message& message : outputs.messages) {
        now_.emplace(wire::message_hash(message.channel, message.payload), message.channel);
      }
      for (const Compute& compute : outputs.computes) {
        ++report_.computes;
        Result<std::string> result = do_work(work_, compute);
        if (result) {
          inputs.push_back(WorkDone{compute.id, std::move(*result)});
        } else {
          differs(result.error().message);
        }
      }
    }
  }

  const std::string& node_;
  NodeCore& core_;
  const std::map<std::string, WorkFunction>& work_;
  ReplayReport& report_;
  std::set<std::string> received_;
  std::int64_t of_another_version_ = 0;
  std::map<std::string, std::string> sent_, now_;  ///< hash -> channel
};

}  // namespace

ReplayReport replay_journal(const std::filesystem::path& journal, NodeCore& core,
                            const std::map<std::string, WorkFunction>& work, bool recompute) {
  ReplayReport report;
  Fold fold(core);
  if (recompute) {
    fold.on_work_done = [&](const Compute& compute, const std::string& recorded) {
      ++report.recomputed;
      return compare_work(work, compute, recorded);
    };
  }
  LogReader reader(journal);
  Result<void> agreed;
  std::int64_t records = 0;
  for (; const auto record = reader.next(); ++records) {
    agreed = fold.feed(*record);
    if (!agreed) break;
  }
  if (records == 0) throw nothing_to_replay(journal);
  const Outputs unfinished = fold.take_unfinished();
  report.inputs = fold.inputs;
  report.outputs = fold.outputs;
  report.computes = fold.computes;
  report.equal = agreed.has_value();
  if (!agreed) {
    report.difference = agreed.error().message;
    return report;
  }
  report.unfinished = unfinished.messages.size() + unfinished.computes.size();
  if (report.unfinished > 0) report.note = "the node was stopped before it wrote down all that its last input caused";
  if (reader.end().torn_bytes > 0)
    report.note += fmt::format("{}the journal ends in a torn record", report.note.empty() ? "" : "; ");
  return report;
}

ReplayReport replay_bus_log(const std::filesystem::path& log, const std::string& node, NodeCore& core,
                            const std::map<std::string, WorkFunction>& work) {
  ReplayReport report;
  report.note =
      "best effort: the bus log holds the order in which the recorder received the messages, not the node; ticks are "
      "not recorded, and work is done at once. The node's own journal gives the exact comparison";
  BusReplay replay(node, core, work, report);
  PiecesReader reader(log);
  std::int64_t records = 0;
  for (; const auto record = reader.next(); ++records) replay.feed(*record);
  if (records == 0) throw nothing_to_replay(log);
  replay.compare();
  return report;
}

}  // namespace nacre::runtime
