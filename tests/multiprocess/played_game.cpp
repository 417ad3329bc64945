#include "played_game.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>

#include <fmt/format.h>

#include "../instrumented.hpp"
#include "program.hpp"
#include "runtime/journal.hpp"
#include "runtime/log_file.hpp"
#include "wire/channels.hpp"
#include "wire/header.hpp"
#include "wire/schema.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kTurnS = 0.02;

const std::vector<std::string> kComparedChannels = {"PARAMETERS", "GAMUT", "PROPOSAL", "TEST_ORDER",  "MEASUREMENT",
                                                    "DIAGNOSIS",  "ROUND", "FAMILY",   "FAMILY_GAMUT"};

/// The environment is the children's too.
std::vector<std::string> with_faults(const std::string& faults, std::vector<std::string> command) {
  if (faults.empty()) {
    ::unsetenv("NACRE_FAULTS");
  } else {
    ::setenv("NACRE_FAULTS", faults.c_str(), 1);
  }
  return command;
}

int round_of(const std::string& channel, const std::string& payload) {
  const auto json = wire::to_json(wire::find_channel(channel)->type, payload);
  return json && json->contains("round") ? json->at("round").get<int>() : -1;
}

void count(SentInGame& sent, const std::string& channel, const std::string& payload) {
  ++sent[{channel, round_of(channel, payload), wire::message_hash(channel, payload)}];
}

std::string in_words(const SentMessage& message, int times) {
  const auto& [channel, round, hash] = message;
  return fmt::format("{} of round {}, {}, sent {} times", channel, round, hash, times);
}

}  // namespace

PlayedGame::PlayedGame(const fs::path& scenario, const fs::path& logs, const std::string& name,
                       const std::string& faults)
    : folder_(logs / name),
      process_(with_faults(faults,
                           {program("nacre"), "launch", scenario.string(), "--logs", logs.string(), "--run", name})) {
  ::unsetenv("NACRE_FAULTS");
}

PlayedGame::PlayedGame(const fs::path& run, const std::string& faults)
    : folder_(run), process_(with_faults(faults, {program("nacre"), "launch", "--resume", run.string()})) {
  ::unsetenv("NACRE_FAULTS");
}

void PlayedGame::play_on() { wait_until_said(process_, "\n\n\n", said_, kTurnS); }

bool PlayedGame::play_until(const std::function<bool()>& condition, double timeout_s) {
  const auto end = Clock::now() + std::chrono::duration<double>(test::kPatience * timeout_s);
  while (!condition()) {
    if (is_over() || Clock::now() > end) return condition();  // it may have come true with the end
    play_on();
  }
  return true;
}

bool PlayedGame::play_to_end(double timeout_s, const std::function<void()>& every_turn) {
  const bool ended = play_until(
      [&] {
        every_turn();
        return is_over();
      },
      timeout_s);
  play_on();
  return ended;
}

void PlayedGame::kill_everything() {
  constexpr double kPatienceS = 10.0;
  ::kill(process_.pid(), SIGKILL);
  wait_for_end(process_, said_, kPatienceS);
  becomes_true([&] { return processes_with(folder_.string()).empty(); }, kPatienceS);
}

int PlayedGame::status() {
  const auto end = process_.poll_end();
  if (!end) return -1;
  return end->signal != 0 ? 128 + end->signal : end->exit_status;
}

int PlayedGame::process_of(const std::string& node) const {
  const std::vector<int> found = processes_with(fmt::format("nacre_{} --run-dir {}", node, folder_.string()));
  return found.empty() ? 0 : found.front();
}

fs::path journal_of(const fs::path& run, const std::string& node) { return run / "nodes" / node / "journal.lcm"; }

std::int64_t journal_bytes(const fs::path& run, const std::string& node) {
  std::error_code missing;
  const auto bytes = fs::file_size(journal_of(run, node), missing);
  return missing ? 0 : static_cast<std::int64_t>(bytes);
}

std::vector<std::string> journaled(const fs::path& run, const std::string& node, const std::string& channel) {
  std::vector<std::string> payloads;
  if (!fs::exists(journal_of(run, node))) return payloads;
  runtime::LogReader reader(journal_of(run, node));
  while (const auto record = reader.next()) {
    if (record->channel != channel) continue;
    if (channel.starts_with('~')) {
      payloads.push_back(record->data);
    } else {
      payloads.push_back(wire::blank_header(channel, record->data)->payload);
    }
  }
  return payloads;
}

SentInGame sent_in_game(const fs::path& run) {
  SentInGame sent;
  for (const std::string& payload : journaled(run, "validation_agent", "RUN")) count(sent, "RUN", payload);
  for (const std::string& node : kGameNodes) {
    for (const std::string& channel : kComparedChannels) {
      const std::string as_output = std::string(runtime::kOutPrefix) + channel;
      for (const std::string& payload : journaled(run, node, as_output)) count(sent, channel, payload);
    }
  }
  return sent;
}

SentInGame on_channels(const SentInGame& sent, const std::vector<std::string>& channels) {
  SentInGame chosen;
  std::copy_if(sent.begin(), sent.end(), std::inserter(chosen, chosen.end()), [&](const auto& entry) {
    return std::find(channels.begin(), channels.end(), std::get<0>(entry.first)) != channels.end();
  });
  return chosen;
}

std::vector<std::string> differences(const SentInGame& expected, const SentInGame& actual) {
  std::vector<std::string> lines;
  for (const auto& [message, times] : expected) {
    const auto found = actual.find(message);
    const int sent = found == actual.end() ? 0 : found->second;
    if (sent != times) lines.push_back(in_words(message, sent) + fmt::format(", expected {}", times));
  }
  for (const auto& [message, times] : actual) {
    if (!expected.contains(message)) lines.push_back(in_words(message, times) + ", expected 0");
  }
  return lines;
}

std::vector<wire::Measurement> measurements_taken(const fs::path& run) {
  std::vector<wire::Measurement> taken;
  for (const std::string& payload : journaled(run, "validation_agent", "MEASUREMENT")) {
    taken.push_back(wire::read<wire::Measurement>(payload).value());
  }
  return taken;
}

void rewrite_journal(const fs::path& from, const fs::path& to,
                     const std::function<std::string(const std::string&, const std::string&)>& change) {
  std::vector<runtime::LogRecord> records;
  for (runtime::LogReader reader(from); auto record = reader.next();) records.push_back(*std::move(record));
  fs::remove(to);
  runtime::LogWriter writer(to);
  for (const runtime::LogRecord& record : records) {
    const Result<void> added = writer.append(record.utime, record.channel, change(record.channel, record.data));
    if (!added) throw InputError(added.error().message);
  }
  if (const Result<void> flushed = writer.flush(); !flushed) throw InputError(flushed.error().message);
}

}  // namespace nacre
