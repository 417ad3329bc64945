#pragma once

#include <set>
#include <string>

#include "wire/channels.hpp"

namespace nacre::runtime {

/// What becomes of a response that reaches a node.
enum class ResponseFate {
  take,     ///< it was requested
  leave,    ///< a node that lost its journal has yet to request this again: the response is repeated until then
  dismiss,  ///< nobody waits for it any more: it is acknowledged and not taken
};

/// The requests that a node has sent. Ids end in the hash of what is requested (docs/decisions/0023): a restarted node
/// that comes to request something else leaves responses behind that nobody waits for.
class PendingRequests {
 public:
  void ask(const std::string& request_id) {
    asked_.insert(request_id);
    places_.insert(wire::place_of(request_id));
  }

  bool asked(const std::string& request_id) const { return asked_.contains(request_id); }

  /// `finished`: the node will request nothing more.
  ResponseFate fate_of(const std::string& request_id, bool finished) const {
    if (asked(request_id)) return ResponseFate::take;
    const bool has_changed = places_.contains(wire::place_of(request_id));
    return has_changed || finished ? ResponseFate::dismiss : ResponseFate::leave;
  }

 private:
  std::set<std::string> asked_, places_;
};

}  // namespace nacre::runtime
