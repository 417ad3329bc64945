#pragma once
// Whole games with the real programs, and what was sent in them.

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "runtime/process.hpp"
#include "wire/convert.hpp"

namespace nacre {

inline const std::vector<std::string> kGameNodes = {"virtual_lab", "simulator_farm", "analyser", "proposal_agent",
                                                    "validation_agent"};

/// `nacre launch` of a scenario in a folder that games share, so that they share the farm's cache too.
class PlayedGame {
 public:
  /// Starts the game. `faults` is NACRE_FAULTS of every process of it.
  PlayedGame(const std::filesystem::path& scenario, const std::filesystem::path& logs, const std::string& name,
             const std::string& faults = "");

  /// `nacre launch --resume` of a game that was stopped.
  explicit PlayedGame(const std::filesystem::path& run, const std::string& faults = "");

  /// Plays on for about 20 ms, keeping what the launcher says.
  void play_on();
  /// Plays until `condition` holds; false when the game or timeout_s is over first.
  bool play_until(const std::function<bool()>& condition, double timeout_s);
  /// Plays to the end, with `every_turn` called some 50 times a second; false when timeout_s is over first.
  bool play_to_end(
      double timeout_s, const std::function<void()>& every_turn = [] {});

  /// SIGKILL for the launcher, which takes every node with it.
  void kill_everything();

  bool is_over() { return process_.poll_end().has_value(); }
  /// Of a game that is over: exit status, or 128 + signal.
  int status();
  const std::string& said() const { return said_; }
  const std::filesystem::path& folder() const { return folder_; }

  /// The process of a node at this moment; 0 when there is none.
  int process_of(const std::string& node) const;

 private:
  std::filesystem::path folder_;
  runtime::ChildProcess process_;
  std::string said_;
};

std::filesystem::path journal_of(const std::filesystem::path& run, const std::string& node);

/// Bytes of a node's journal so far, 0 before it is begun.
std::int64_t journal_bytes(const std::filesystem::path& run, const std::string& node);

/// What identifies a message of a game: channel, round, hash of the payload without header; and how often it was sent.
using SentMessage = std::tuple<std::string, int, std::string>;
using SentInGame = std::map<SentMessage, int>;

/// Everything sent on the channels by which games are compared (RUN, PARAMETERS, GAMUT, PROPOSAL, TEST_ORDER,
/// MEASUREMENT, DIAGNOSIS, ROUND, FAMILY, FAMILY_GAMUT), from the nodes' journals: their outputs, and RUN as the
/// validation agent received it.
SentInGame sent_in_game(const std::filesystem::path& run);

/// Only what was sent on some of the channels.
SentInGame on_channels(const SentInGame& sent, const std::vector<std::string>& channels);

/// What one game has and the other has not, a line each: empty for equal games.
std::vector<std::string> differences(const SentInGame& expected, const SentInGame& actual);

/// Payloads that a node's journal holds on a channel, outputs as "~out/CHANNEL".
std::vector<std::string> journaled(const std::filesystem::path& run, const std::string& node,
                                   const std::string& channel);

/// The MEASUREMENTs that the validation agent took in, in the order they came.
std::vector<wire::Measurement> measurements_taken(const std::filesystem::path& run);

/// Copies a journal with a change to its records: `change` returns the record's new bytes.
void rewrite_journal(const std::filesystem::path& from, const std::filesystem::path& to,
                     const std::function<std::string(const std::string& channel, const std::string& data)>& change);

}  // namespace nacre
