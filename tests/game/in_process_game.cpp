#include "in_process_game.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "runtime/journal.hpp"
#include "runtime/log_file.hpp"
#include "wire/channels.hpp"
#include "wire/header.hpp"
#include "wire/schema.hpp"

namespace nacre::game_test {
namespace {

void write_input(runtime::LogWriter& writer, const runtime::Input& input) {
  if (const auto* message = std::get_if<runtime::Message>(&input)) {
    const wire::Header header{1, "game", 1, 1, "game"};
    ASSERT_TRUE(writer.append(1, message->channel, wire::stamp_header(message->channel, message->payload, header)));
  } else if (const auto* done = std::get_if<runtime::WorkDone>(&input)) {
    ASSERT_TRUE(writer.append(1, runtime::kWorkChannel, runtime::pack({done->id, done->result})));
  }
}

}  // namespace

void InProcessGame::add(const std::string& node, std::unique_ptr<runtime::NodeCore> core,
                        std::map<std::string, runtime::WorkFunction> work) {
  nodes_[node] = {std::move(core), std::move(work)};
}

void InProcessGame::publish(const runtime::Message& message) {
  const wire::Channel* channel = wire::find_channel(message.channel);
  ASSERT_NE(channel, nullptr) << message.channel;
  const auto sound = channel->validate(message.payload);
  ASSERT_TRUE(sound) << message.channel << ": " << sound.error().message;
  ASSERT_LT(message.payload.size(), wire::kMaximumPayload) << message.channel;
  if (known_contents_.emplace(message.channel, message.payload).second) sent_.push_back(message);
  for (const auto& [name, node] : nodes_) {
    if (wire::is_meant_for(*channel, message.payload, name)) pending_.push_back({name, message});
  }
}

void InProcessGame::announce(const game::Scenario& scenario) {
  wire::RunStart run;
  run.seed = static_cast<std::int64_t>(scenario.seed);
  run.scenario_hash = "in process";
  run.schema_version = 1;
  publish({"RUN", wire::write(run)});
}

void InProcessGame::take_outputs(const std::string& node, runtime::Outputs outputs) {
  for (const runtime::LogLine& line : outputs.log) {
    if (line.level >= runtime::LogLevel::warning) complaints_[node].push_back(line.text);
  }
  if (!outputs.refusal.empty()) refusals_[node].push_back(outputs.refusal);
  for (const runtime::Message& message : outputs.messages) publish(message);
  for (const runtime::Compute& compute : outputs.computes) {
    work_ids_[node].push_back(compute.id);
    pending_.push_back({node, runtime::WorkDone{compute.id, nodes_.at(node).work.at(compute.kind)(compute.spec)}});
  }
}

void InProcessGame::play() {
  while (!pending_.empty() && !testing::Test::HasFatalFailure()) {
    const std::size_t index =
        delivery_.seed == 0 ? 0 : static_cast<std::size_t>(random_.index(static_cast<int>(pending_.size())));
    const Pending next = pending_[index];
    pending_.erase(pending_.begin() + static_cast<std::ptrdiff_t>(index));
    // Results of long work come once; messages may come again.
    if (std::holds_alternative<runtime::Message>(next.input) && random_.uniform() < delivery_.repeat_probability) {
      pending_.push_back(next);
    }
    const double begin_s = processor_time_s();
    runtime::Outputs outputs = nodes_.at(next.node).core->step(next.input);
    longest_step_s_ = std::max(longest_step_s_, processor_time_s() - begin_s);
    journal_[next.node].emplace_back(next.input, outputs);
    take_outputs(next.node, std::move(outputs));
  }
}

std::vector<std::string> InProcessGame::payloads(const std::string& channel) const {
  std::vector<std::string> all;
  for (const runtime::Message& message : sent_) {
    if (message.channel == channel) all.push_back(message.payload);
  }
  return all;
}

std::set<std::pair<std::string, std::string>> InProcessGame::essence() const {
  static const std::set<std::string> kChannels = {"RUN",         "PARAMETERS", "GAMUT", "PROPOSAL", "TEST_ORDER",
                                                  "MEASUREMENT", "DIAGNOSIS",  "ROUND", "FAMILY",   "FAMILY_GAMUT"};
  std::set<std::pair<std::string, std::string>> contents;
  for (const runtime::Message& message : sent_) {
    if (kChannels.contains(message.channel)) contents.emplace(message.channel, message.payload);
  }
  return contents;
}

std::size_t InProcessGame::replay(const std::string& node, runtime::NodeCore& fresh) const {
  const auto& journal = journal_.at(node);
  for (const auto& [input, expected] : journal) {
    const runtime::Outputs outputs = fresh.step(input);
    EXPECT_EQ(outputs.messages, expected.messages);
    EXPECT_EQ(outputs.computes, expected.computes);
    EXPECT_EQ(outputs.log, expected.log);
  }
  return journal.size();
}

std::int64_t InProcessGame::write_journal(const std::string& node, const std::filesystem::path& file) const {
  runtime::LogWriter writer(file);
  std::int64_t records = 0;
  for (const auto& [input, outputs] : journal_.at(node)) {
    write_input(writer, input);
    for (const runtime::Message& message : outputs.messages) {
      EXPECT_TRUE(writer.append(1, std::string(runtime::kOutPrefix) + message.channel, message.payload));
    }
    for (const runtime::Compute& compute : outputs.computes) {
      EXPECT_TRUE(writer.append(1, runtime::kComputeChannel,
                                runtime::pack({compute.id, compute.kind, runtime::journaled_spec(compute)})));
    }
    records += 1 + static_cast<std::int64_t>(outputs.messages.size() + outputs.computes.size());
  }
  EXPECT_TRUE(writer.flush());
  return records;
}

}  // namespace nacre::game_test
