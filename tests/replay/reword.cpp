#include "reword.hpp"

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/expected.hpp"
#include "base/result.hpp"
#include "game/scenario.hpp"
#include "golden_game.hpp"
#include "golden_nodes.hpp"
#include "runtime/content_difference.hpp"
#include "runtime/journal.hpp"
#include "runtime/log_file.hpp"
#include "transcript.hpp"
#include "wire/channels.hpp"
#include "wire/from_json.hpp"
#include "wire/header.hpp"
#include "wire/schema.hpp"

namespace nacre::golden {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Fields that are sentences for people, by message type: no node decides by them. STATUS and log lines hold more of
/// them, and are not recorded.
const std::map<std::string_view, std::vector<std::string_view>> kSentences = {
    {"diagnosis_t", {"summary", "next_experiments[].reason"}},
    {"measurement_t", {"note"}},
    {"proposal_t", {"designs[].reason"}},
    {"round_summary_t", {"decided_by"}},
    {"simulate_result_t", {"results[].reason"}},
};

const wire::Channel* channel_of(const std::string& bytes) {
  for (const wire::Channel& channel : wire::channels()) {
    if (wire::fingerprint_of(bytes) == channel.fingerprint) return &channel;
  }
  return nullptr;
}

/// Calls `use` with every text that `field` names: "decided_by", "designs[].reason".
void each_text(Json& message, std::string_view field, const std::function<void(Json&)>& use) {
  const std::size_t array = field.find("[].");
  if (array == std::string_view::npos) return use(message.at(std::string(field)));
  for (Json& element : message.at(std::string(field.substr(0, array))))
    each_text(element, field.substr(array + 3), use);
}

std::vector<std::string_view> sentences_of(std::string_view type) {
  const auto known = kSentences.find(type);
  return known == kSentences.end() ? std::vector<std::string_view>{} : known->second;
}

/// The message with a mark in place of every sentence; which sentences there are is told to `tell`.
std::string blanked(const wire::Channel& channel, const std::string& bytes,
                    const std::function<void(std::string_view field, const std::string& sentence)>& tell = {}) {
  Json message = expected(wire::to_json(channel.type, bytes));
  for (const std::string_view field : sentences_of(channel.type)) {
    each_text(message, field, [&](Json& text) {
      if (tell) tell(field, text.get<std::string>());
      if (text != "") text = "...";
    });
  }
  return expected(wire::from_json(channel.type, message));
}

bool holds_sentences(const std::string& bytes) {
  const wire::Channel* channel = channel_of(bytes);
  return channel != nullptr && blanked(*channel, bytes) != bytes;
}

/// That two contents differ in sentences alone: messages, and records of runtime::pack() that hold them.
Result<void> expect_same_but_sentences(const std::string& recorded, const std::string& now) {
  if (recorded == now) return {};
  const wire::Channel* channel = channel_of(recorded);
  if (channel != nullptr && channel == channel_of(now)) {
    const std::string a = blanked(*channel, recorded), b = blanked(*channel, now);
    if (a == b) return {};
    return fail("{}", runtime::content_difference(a, b));
  }
  const auto a = runtime::unpack(recorded), b = runtime::unpack(now);
  if (!a || !b || a->size() != b->size()) return fail("{}", runtime::content_difference(recorded, now));
  for (std::size_t i = 0; i < a->size(); ++i) {
    if (const auto same = expect_same_but_sentences((*a)[i], (*b)[i]); !same)
      return fail("field {}: {}", i, same.error().message);
  }
  return {};
}

/// New contents of messages that were reworded, by channel and content of before.
using Reworded = std::map<std::pair<std::string, std::string>, std::string>;
/// Results of work that was done again, by kind and spec.
using Redone = std::map<std::pair<std::string, std::string>, std::string>;

/// One node's journal, read against a fresh core and written anew.
class NodeRewording {
 public:
  NodeRewording(const std::string& node, runtime::NodeProgram program, Reworded& reworded, Redone& redone,
                Rewording& rewording)
      : node_(node), program_(std::move(program)), reworded_(reworded), redone_(redone), rewording_(rewording) {}

  void rewrite(const fs::path& journal, const fs::path& anew) {
    fs::create_directories(anew.parent_path());
    fs::remove(anew);
    runtime::LogWriter writer(anew);
    for (runtime::LogReader reader(journal); const auto record = reader.next();) {
      place_ = fmt::format("{}: record {} ({})", node_, record->number, record->channel);
      const std::string data = rewritten(*record);
      if (const auto written = writer.append(0, record->channel, data); !written)
        throw InputError(written.error().message);
    }
    place_ = node_ + ": at the end";
    expect_nothing_more();
  }

 private:
  std::string rewritten(const runtime::LogRecord& record) {
    if (record.channel.starts_with(runtime::kOutPrefix)) return output(record);
    if (record.channel == runtime::kComputeChannel) return compute(record);
    if (record.channel == runtime::kWorkChannel) return work_done(record);
    if (record.channel == runtime::kTickChannel) {
      step(runtime::Tick{std::stoll(expected(runtime::unpack(record.data)).at(0))});
      return record.data;
    }
    return message(record);
  }

  std::string message(const runtime::LogRecord& record) {
    const wire::Blanked before = expected(wire::blank_header(record.channel, record.data));
    const auto anew = reworded_.find({record.channel, before.payload});
    const std::string& payload = anew == reworded_.end() ? before.payload : anew->second;
    step(runtime::Message{record.channel, payload});
    return wire::stamp_header(record.channel, payload, before.header);
  }

  std::string work_done(const runtime::LogRecord& record) {
    const std::vector<std::string> fields = expected(runtime::unpack(record.data));
    const auto asked = asked_.find(fields.at(0));
    if (asked == asked_.end()) refuse("nobody asked for this work");
    const runtime::Compute& compute = asked->second;
    std::string result = fields.at(1);
    if (holds_sentences(result)) {
      result = done_again(compute);
      expect_same(fields.at(1), result);
    }
    step(runtime::WorkDone{compute.id, result});
    return runtime::pack({compute.id, result});
  }

  std::string done_again(const runtime::Compute& compute) {
    const auto [place, is_new] = redone_.try_emplace({compute.kind, compute.spec});
    if (is_new) place->second = program_.work.at(compute.kind)(compute.spec);
    return place->second;
  }

  std::string output(const runtime::LogRecord& record) {
    if (messages_.empty()) refuse("the core does not send this any more");
    const runtime::Message now = std::move(messages_.front());
    messages_.pop_front();
    if (runtime::kOutPrefix.size() + now.channel.size() != record.channel.size() ||
        !record.channel.ends_with(now.channel))
      refuse(fmt::format("the core sends {} instead", now.channel));
    expect_same(record.data, now.payload);
    count(record.data, now.payload);
    if (now.payload != record.data) reworded_[{now.channel, record.data}] = now.payload;
    return now.payload;
  }

  std::string compute(const runtime::LogRecord& record) {
    const std::vector<std::string> fields = expected(runtime::unpack(record.data));
    if (computes_.empty()) refuse("the core does not ask for this work any more");
    const runtime::Compute now = std::move(computes_.front());
    computes_.pop_front();
    const std::string spec = runtime::journaled_spec(now);
    expect_same(fields.at(2), spec);
    // What is stored is named by its hash.
    const bool is_named_by_content = now.kind == "store" && fields.at(2) != spec;
    if (fields.at(1) != now.kind || (fields.at(0) != now.id && !is_named_by_content))
      refuse(fmt::format("recorded the work {} ({}), now {} ({})", fields.at(0), fields.at(1), now.id, now.kind));
    rewording_.ids += fields.at(0) != now.id;
    asked_[fields.at(0)] = now;
    return runtime::pack({now.id, now.kind, spec});
  }

  void step(const runtime::Input& input) {
    expect_nothing_more();
    runtime::Outputs outputs = program_.core->step(input);
    messages_.assign(outputs.messages.begin(), outputs.messages.end());
    computes_.assign(outputs.computes.begin(), outputs.computes.end());
  }

  void expect_nothing_more() const {
    if (!messages_.empty()) refuse(fmt::format("the core now also sends {}", messages_.front().channel));
    if (!computes_.empty()) refuse(fmt::format("the core now also asks for the work {}", computes_.front().id));
  }

  void expect_same(const std::string& recorded, const std::string& now) const {
    if (const auto same = expect_same_but_sentences(recorded, now); !same) refuse(same.error().message);
  }

  void count(const std::string& recorded, const std::string& now) const {
    const wire::Channel& channel = *channel_of(recorded);
    std::map<std::string_view, std::vector<std::string>> before, after;
    blanked(channel, recorded, [&](std::string_view field, const std::string& text) { before[field].push_back(text); });
    blanked(channel, now, [&](std::string_view field, const std::string& text) { after[field].push_back(text); });
    for (const auto& [field, texts] : before) {
      RewordedField& counts = rewording_.fields[fmt::format("{}.{}", channel.type, field)];
      ++counts.outputs;
      counts.changed += texts != after.at(field);
    }
  }

  [[noreturn]] void refuse(const std::string& difference) const {
    throw InputError::format("{}: {}; only sentences may differ", place_, difference);
  }

  const std::string& node_;
  runtime::NodeProgram program_;
  Reworded& reworded_;
  Redone& redone_;
  Rewording& rewording_;
  std::string place_;
  std::deque<runtime::Message> messages_;
  std::deque<runtime::Compute> computes_;
  std::map<std::string, runtime::Compute> asked_;  ///< by recorded id, as asked for now
};

}  // namespace

Rewording reword_golden_game(const fs::path& folder, const fs::path& scratch) {
  const fs::path recorded = scratch / "recorded", anew = scratch / "anew";
  unpack_golden_game(folder, recorded);
  unpack_golden_game(folder, anew);  // scenario and inputs; the journals are replaced
  const game::Scenario scenario = game::read_scenario(recorded / "scenario.toml");
  Reworded reworded;
  Redone redone;
  // What one node sends another one receives, and stores or sends on: until nothing is reworded that was not before.
  for (int turn = 0;; ++turn) {
    const Reworded before = reworded;
    Rewording rewording;
    for (const std::string& node : nodes_of(recorded)) {
      const fs::path journal = fs::path("nodes") / node / "journal.lcm";
      NodeRewording(node, make_node(node, scenario, scratch / fmt::format("work-{}-{}", turn, node)), reworded, redone,
                    rewording)
          .rewrite(recorded / journal, anew / journal);
    }
    if (reworded != before) continue;
    write_golden_game(anew, folder);
    write_transcript(recorded_lines(anew), folder);
    return rewording;
  }
}

}  // namespace nacre::golden
