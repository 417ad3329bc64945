#pragma once
// The channel table of lcmtypes/README.md as data: what travels on a channel, who must acknowledge it, how it is
// validated.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "base/result.hpp"

namespace nacre::wire {

/// Receiver that stands for every node of the run.
inline constexpr std::string_view kEveryNode = "*";
/// Receiver that stands for the node that `request_id` names before its first '/'.
inline constexpr std::string_view kRequester = "requester";

struct Channel {
  std::string_view name;
  std::string_view type;
  std::int64_t fingerprint = 0;
  std::vector<std::string_view> receivers;  ///< node names, kEveryNode or kRequester
  bool reliable = false;                    ///< repeated until every receiver in the run has acknowledged
  bool synced = false;                      ///< acknowledged only when on disk
  /// Everything that can be wrong with a payload: structure, finite numbers, enumerations, physical ranges, design
  /// names.
  Result<void> (*validate)(std::string_view payload) = nullptr;
  /// The JSON Schema of to_json() with a member `header` (message_json.hpp).
  nlohmann::ordered_json (*schema)() = nullptr;
  /// A message's fields by their table, designs as their names; what is absent has no member. Refuses what validate()
  /// refuses.
  Result<nlohmann::ordered_json> (*to_json)(std::string_view payload) = nullptr;
};

/// All channels, in the order of the table.
std::span<const Channel> channels();

/// The channel of that name, or nullptr.
const Channel* find_channel(std::string_view name);

/// Whether `node` listens to the channel at all (for a requester's channel: every node may be one).
bool listens(const Channel& channel, std::string_view node);

/// Those of `participants` that must acknowledge a message that `sender` publishes.
std::vector<std::string> receivers_of(const Channel& channel, std::string_view payload,
                                      std::span<const std::string> participants, std::string_view sender);

/// Whether this message is meant for `node`: as listens(), and for a requester's channel the request must be the
/// node's own.
bool is_meant_for(const Channel& channel, std::string_view payload, std::string_view node);

/// Whether a message may be sent: the channel exists, the payload is valid and leaves room for the header.
Result<void> check_outgoing(std::string_view channel, std::string_view payload);

/// Whether the messages of a channel are responses to requests, and go to the requester.
bool is_response(std::string_view channel);

/// The request that a SIMULATE, SIMULATED or FRACTURE message belongs to; empty for other channels.
std::string request_id_of(std::string_view channel, std::string_view payload);

/// The name before the first '/' of a request id; empty when there is none.
std::string_view requester_of(std::string_view request_id);

/// A request id without the hash that with_content_id() appends: the purpose of the request.
std::string place_of(std::string_view request_id);

}  // namespace nacre::wire
