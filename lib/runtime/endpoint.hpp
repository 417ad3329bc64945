#pragma once
// Reliable delivery for programs without a journal: the launcher, `nacre inject`, `approve`, `review`.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "runtime/bus.hpp"
#include "runtime/reliable.hpp"

namespace nacre::runtime {

/// Sends until acknowledged; listens to STATUS (and to `channels`) meanwhile. Incoming reliable messages are handed
/// over and not acknowledged: only journals acknowledge.
class Endpoint {
 public:
  /// `participants`: the nodes of the run, as in the scenario.
  static Result<std::unique_ptr<Endpoint>> open(BusOptions options, std::vector<std::string> participants,
                                                std::vector<std::string> channels = {});
  /// Starts sending a message; validated first. Returns its hash.
  Result<std::string> offer(const Message& message);
  /// Receives and repeats for up to timeout_ms.
  void pump(int timeout_ms, const std::function<void(const Received&)>& handler = {});
  /// Pumps until everything offered is acknowledged; false when timeout_s is over first.
  bool deliver(double timeout_s, const std::function<void(const Received&)>& handler = {});
  int unacknowledged() const { return outbox_.unacknowledged(); }
  std::set<std::string> waiting_for(const std::string& hash) const { return outbox_.waiting_for(hash); }
  /// Why a node that has the message refuses it, as a sentence; nothing where none does.
  std::optional<std::string> refusal_of(const std::string& hash) const;
  Bus& bus() { return *bus_; }

 private:
  Endpoint(std::unique_ptr<Bus> bus, std::string node, std::vector<std::string> participants);
  void handle(const Received& received);
  std::unique_ptr<Bus> bus_;
  std::string node_;
  std::vector<std::string> participants_;
  std::vector<Message> offered_;  ///< by place
  Outbox outbox_;
  std::map<std::string, std::string> refusals_;  ///< by hash
};

}  // namespace nacre::runtime
