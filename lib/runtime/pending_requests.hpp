#pragma once

#include <set>
#include <string>

#include "wire/channels.hpp"

namespace nacre::runtime {

/// What becomes of an answer that reaches a node.
enum class ResponseFate {
  take,     ///< it was asked
  leave,    ///< a node that lost its journal has yet to ask this again: the answer is repeated until then
  dismiss,  ///< nobody waits for it any more: it is acknowledged and not taken
};

/// The requests that a node has asked. Ids end in the hash of what is asked (docs/decisions/0023): a node that began
/// anew and came to ask something else leaves answers behind that nobody waits for.
class PendingRequests {
 public:
  void ask(const std::string& request_id) {
    asked_.insert(request_id);
    places_.insert(wire::place_of(request_id));
  }

  bool asked(const std::string& request_id) const { return asked_.contains(request_id); }

  /// `finished`: the node will ask nothing more.
  ResponseFate fate_of(const std::string& request_id, bool finished) const {
    if (asked(request_id)) return ResponseFate::take;
    const bool asked_otherwise = places_.contains(wire::place_of(request_id));
    return asked_otherwise || finished ? ResponseFate::dismiss : ResponseFate::leave;
  }

 private:
  std::set<std::string> asked_, places_;
};

}  // namespace nacre::runtime
