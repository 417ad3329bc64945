#pragma once
// Reliable delivery over a bus that drops, repeats and reorders: pure state machines, time passed in as microseconds.

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "runtime/node_core.hpp"

namespace nacre::runtime {

struct ReliableSettings {
  std::int64_t first_retry_us = 50'000;
  std::int64_t last_retry_us = 1'000'000;
  std::size_t window_bytes = 200'000;  ///< sent and not acknowledged, per receiver; the others wait in order
  std::int64_t ack_delay_us = 20'000;
};

/// A message to be delivered. Its bytes are kept by whoever offers it: a node's stand in its journal.
struct Parcel {
  std::string hash;
  std::int64_t place = 0;  ///< by which the owner finds the bytes again
  std::size_t size_bytes = 0;
  std::string request_id;  ///< of a response
  std::vector<std::string> receivers;
};

/// What `self` delivers for a message whose bytes it keeps at `place`; `participants`: the nodes of the run.
Parcel parcel_of(const Message& message, std::int64_t place, const std::vector<std::string>& participants,
                 std::string_view self);

/// Messages on their way out, each until every receiver has acknowledged it.
class Outbox {
 public:
  explicit Outbox(ReliableSettings settings = {}) : settings_(settings) {}

  /// Takes a message. One that is already known (same hash) is not taken twice.
  void offer(const Parcel& parcel);

  /// `node` has the message in its journal of that identity. True when that was news (worth writing down).
  bool acknowledge(const std::string& hash, const std::string& node, std::int64_t epoch, std::int64_t journal);

  /// What was seen of `node` in its STATUS. A new epoch: what it has not acknowledged is due at once. What was
  /// acknowledged for another journal than this one is lost and offered again.
  void saw(const std::string& node, std::int64_t epoch, std::int64_t journal);

  /// `node` sent its request again from a new process: the responses are offered to it once more.
  void respond_again(const std::string& request_id, const std::string& node, std::int64_t epoch);

  /// Places of the messages to send now; each counts as sent.
  std::vector<std::int64_t> due(std::int64_t now_us);
  /// When due() has something next; nothing when it will not before something happens.
  std::optional<std::int64_t> next_due() const;

  /// Messages that somebody has not acknowledged (or that were not sent yet).
  int unacknowledged() const { return active_.size(); }
  std::int64_t retries() const { return retries_; }
  /// Nodes that a message is still waiting for.
  std::set<std::string> waiting_for(const std::string& hash) const;
  bool knows(const std::string& hash) const { return entries_.count(hash) != 0; }

 private:
  struct Peer {
    std::string node;
    std::int64_t epoch = 0;
    std::int64_t journal = 0;
    bool unchecked = false;  ///< acknowledged something for another journal than the one last seen
  };
  struct Delivery {
    Peer* to = nullptr;
    std::int64_t epoch = 0, journal = 0;  ///< of the acknowledgement
    bool acknowledged = false;
  };
  // Kept for as long as a receiver may lose its journal, so for the whole run.
  struct OfferedMessage {
    std::int64_t place = 0;
    std::size_t size_bytes = 0;
    std::string request_id;
    std::vector<Delivery> deliveries;  ///< none: sent once, nobody must acknowledge
    std::int64_t next_us = 0;
    std::int64_t interval_us = 0;  ///< 0: due at once
    std::uint64_t order = 0;
    bool sent = false;

    Delivery* to(std::string_view node);
    bool is_waiting() const;
  };
  Peer& peer(const std::string& node);
  void restart(OfferedMessage& entry);
  std::vector<OfferedMessage*> admitted() const;

  ReliableSettings settings_;
  std::unordered_map<std::string, OfferedMessage> entries_;
  std::map<std::uint64_t, OfferedMessage*> active_;  ///< not yet acknowledged by all, in the order offered
  std::map<std::string, Peer> peers_;
  std::uint64_t next_order_ = 0;
  std::int64_t retries_ = 0;
};

/// Messages that came in: which are known, which acknowledgements are owed.
class Inbox {
 public:
  explicit Inbox(ReliableSettings settings = {}) : settings_(settings) {}
  /// True for a message not seen before.
  bool is_new(const std::string& hash) const { return known_.count(hash) == 0; }
  /// The message is in the journal.
  void remember(const std::string& hash) { known_.insert(hash); }
  /// The message changes nothing: every acknowledgement of it says why.
  void refuse(const std::string& hash, std::string reason) { refusals_.emplace(hash, std::move(reason)); }
  /// Nothing where the message is not refused.
  const std::string* refusal_of(const std::string& hash) const;
  /// Owes an acknowledgement (also for duplicates: the first one may be lost).
  void owe(const std::string& hash, std::int64_t now_us);
  /// The hashes to acknowledge now, as many as fit a datagram with their refusals (1000 without); empty before the
  /// delay is over.
  std::vector<std::string> due(std::int64_t now_us);
  std::optional<std::int64_t> next_due() const;
  std::size_t size() const { return known_.size(); }
  std::size_t owed() const { return owed_.size(); }
  std::int64_t duplicates = 0;

 private:
  ReliableSettings settings_;
  std::unordered_set<std::string> known_;
  std::unordered_map<std::string, std::string> refusals_;
  std::deque<std::string> owed_;
  std::unordered_set<std::string> owed_set_;
  std::int64_t owed_since_us_ = 0;
};

}  // namespace nacre::runtime
