#pragma once
// Listens to a run that is playing: the nodes' STATUS, and what its search has simulated.

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "dashboard/desk.hpp"
#include "dashboard/live_search.hpp"
#include "runtime/bus.hpp"

namespace nacre::dashboard {

class LiveFeed {
 public:
  struct Source {
    /// Opens a bus that listens to STATUS and SIMULATED. May throw InputError.
    std::function<std::unique_ptr<runtime::Bus>()> open;
    /// Identifies the bus: a resumed run may play on another port.
    std::function<std::string()> identity;
    /// Hands out the payloads of SIMULATED that were recorded before, on the listening thread.
    std::function<void(const std::function<void(const std::string& payload)>& take)> recorded;
  };
  explicit LiveFeed(Source source);
  ~LiveFeed();

  /// Nodes that have reported within a minute, by name, with the age of their last report.
  std::vector<NodeReport> nodes() const;
  const LiveSearch& search() const { return search_; }
  /// Why nothing can be received; empty when all is well.
  std::string problem() const;

 private:
  struct Heard {
    wire::NodeStatus status;
    std::int64_t when_us = 0;
  };
  void listen();
  void take_result(const std::string& payload);
  void receive_until_moved(runtime::Bus& bus, const std::string& identity);
  Source source_;
  mutable std::mutex mutex_;
  std::map<std::string, Heard> heard_;
  std::string problem_;
  LiveSearch search_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace nacre::dashboard
