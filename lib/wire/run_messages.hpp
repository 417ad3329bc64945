#pragma once
// Messages that run a game rather than play it: RUN, what people decide, what a laboratory reveals at the end,
// acknowledgements, questions and the nodes' status.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "nacre/ack_t.hpp"
#include "nacre/approval_t.hpp"
#include "nacre/ask_t.hpp"
#include "nacre/node_status_t.hpp"
#include "nacre/reveal_t.hpp"
#include "nacre/review_t.hpp"
#include "nacre/run_t.hpp"
#include "nacre/withdrawal_t.hpp"
#include "pattern/design.hpp"
#include "wire/parts.hpp"

namespace nacre::wire {

/// RUN: which game is played.
struct RunStart {
  using Wire = run_t;
  std::int64_t seed = 0;
  std::string scenario_hash;
  int schema_version = 1;  ///< of the message types
  bool operator==(const RunStart&) const = default;

  static void fields(auto& field, auto& m) {
    field("seed", m.seed);
    field("scenario_hash", m.scenario_hash, kName);
    field("schema_version", m.schema_version, Range{1, kCounted.most});
  }
};

/// APPROVAL: a person's yes or no to one proposed design, or a design of the person's own.
struct Approval {
  using Wire = approval_t;
  int round = -1;  ///< of the proposal; -1: a design of the person's own, to which only a yes makes sense
  pattern::Design design;
  bool approved = true;
  std::string by, why;
  bool operator==(const Approval&) const = default;

  static void fields(auto& field, auto& m) {
    field("round", m.round, Range{-1, kRoundNumber.most});
    field("design", m.design);
    field("approved", m.approved);
    field("by", m.by);
    field("why", m.why);
  }
  std::string contradiction() const {
    return round >= 0 || approved ? "" : "round: -1 is outside [0, 100000] where a design is refused";
  }
};

/// WITHDRAWAL: an order is not to be made, or is after all; the highest revision wins.
struct Withdrawal {
  using Wire = withdrawal_t;
  std::string order_id;
  int revision = 1;
  bool withdrawn = true;  ///< false: the order is given again
  std::string by, why;
  bool operator==(const Withdrawal&) const = default;

  static void fields(auto& field, auto& m) {
    field("order_id", m.order_id, kName);
    field("revision", m.revision, Range{1, kCounted.most});
    field("withdrawn", m.withdrawn);
    field("by", m.by, kName);
    field("why", m.why);
  }
  std::string contradiction() const {
    const bool has_reason = why.find_first_not_of(' ') != std::string::npos;
    return has_reason || !withdrawn ? "" : fmt::format("why: is empty, expected why {} is withdrawn", order_id);
  }
};

/// REVIEW: whether one specimen is valid; the highest revision wins.
struct Review {
  using Wire = review_t;
  std::string specimen;
  int revision = 0;
  bool valid = false;
  std::string by, why;
  bool operator==(const Review&) const = default;

  static void fields(auto& field, auto& m) {
    field("specimen", m.specimen, kName);
    field("revision", m.revision, kCounted);
    field("valid", m.valid);
    field("by", m.by);
    field("why", m.why);
  }
};

/// A cause that a virtual laboratory hid in its measurements.
struct HiddenCause {
  std::string name;
  std::string meaning;     ///< of its first value, in words, with its unit
  bool in_library = true;  ///< false: the diagnosis has no name for it
  std::vector<double> values;
  bool operator==(const HiddenCause&) const = default;

  static void fields(auto& field, auto& m) {
    field("name", m.name, kName);
    field("meaning", m.meaning);
    field("in_library", m.in_library);
    field.count("n_values", m.values, Range{1, 2});
    field("values", m.values);
  }
};

/// REVEAL: what a virtual laboratory had hidden, after the last round.
struct Reveal {
  using Wire = reveal_t;
  material::ParameterSet parameters;                  ///< of its materials, without the causes
  double modulus_noise = 0.0, toughness_noise = 0.0;  ///< relative standard deviations between replicates
  std::vector<HiddenCause> causes;
  bool operator==(const Reveal&) const = default;

  static void fields(auto& field, auto& m) {
    field("parameters", m.parameters);
    field("modulus_noise", m.modulus_noise, Range{0, 1});
    field("toughness_noise", m.toughness_noise, Range{0, 1});
    field.count("n_causes", m.causes, Range{0, 10});
    field("causes", m.causes);
  }
};

/// Why a receiver will not have a message.
struct Refusal {
  std::string hash;
  std::string reason;  ///< a sentence
  bool operator==(const Refusal&) const = default;
};

/// ACK: messages that stand in the sender's journal.
struct Ack {
  using Wire = ack_t;
  std::int64_t journal = 0;  ///< when that journal was begun, as in STATUS
  std::vector<std::string> hashes;
  std::vector<Refusal> refused;  ///< of the hashes, those that change nothing
  bool operator==(const Ack&) const = default;

  static std::string hash_fault(std::string_view hash) {
    const bool is_hex = hash.size() == 32 && hash.find_first_not_of("0123456789abcdef") == std::string_view::npos;
    return is_hex ? "" : fmt::format("\"{}\" is not a hash of 32 hex digits", hash.substr(0, 40));
  }
  static void fields(auto& field, auto& m) {
    field("journal", m.journal);
    field.count("n_hashes", m.hashes);
    field("hashes", m.hashes, hash_fault);
    field.count("n_refused", m.refused);
    field.columns(m.refused, [](auto& column, auto& refusal) {
      column("refused", refusal.hash, hash_fault);
      column("reason", refusal.reason);
    });
  }
};

/// ASK: a program that came later wants to hear again what is still open of a channel.
struct Ask {
  using Wire = ask_t;
  std::string channel;
  bool operator==(const Ask&) const = default;

  static constexpr std::array<std::string_view, 2> kChannels = {"TEST_ORDER", "PROPOSAL"};
  static void fields(auto& field, auto& m) { field("channel", m.channel, OneOf{kChannels}); }
};

/// STATUS: what a node says of itself; the meaning of each field stands in node_status_t.lcm.
struct NodeStatus {
  using Wire = node_status_t;
  std::int64_t journal = 0;
  bool ready = false, finished = false;
  std::string phase;
  int round = 0;
  double progress = 0.0;  ///< -1 when unknown
  double eta_s = 0.0;     ///< -1 when unknown
  std::int64_t received = 0, published = 0, retries = 0, duplicates = 0, rejected = 0, lost = 0, dropped = 0;
  int unacknowledged = 0, queued = 0, owed = 0, computing = 0;
  std::int64_t journal_bytes = 0;
  std::string work, last_problem;
  bool operator==(const NodeStatus&) const = default;

  static void fields(auto& field, auto& m) {
    field("journal", m.journal);
    field("ready", m.ready);
    field("finished", m.finished);
    field("phase", m.phase);
    field("round", m.round);
    field("progress", m.progress, Range{-1.0, 1.0});
    field("eta_s", m.eta_s);
    counters(field, m);
  }
  /// Counters, queues, work and last problem.
  static void counters(auto& field, auto& m) {
    field("received", m.received);
    field("published", m.published);
    field("retries", m.retries);
    field("duplicates", m.duplicates);
    field("rejected", m.rejected);
    field("lost", m.lost);
    field("dropped", m.dropped);
    field("unacknowledged", m.unacknowledged, kCounted);
    field("queued", m.queued);
    field("owed", m.owed);
    field("computing", m.computing, kCounted);
    field("journal_bytes", m.journal_bytes);
    field("work", m.work);
    field("last_problem", m.last_problem);
  }
};

}  // namespace nacre::wire
