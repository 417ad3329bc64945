#pragma once
// Listens to the STATUS messages of a run that is playing.

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "dashboard/desk.hpp"
#include "runtime/bus.hpp"

namespace nacre::dashboard {

class LiveFeed {
 public:
  struct Source {
    /// Opens a bus that listens to STATUS. May throw InputError.
    std::function<std::unique_ptr<runtime::Bus>()> open;
    /// Identifies the bus: a resumed run may play on another port.
    std::function<std::string()> identity;
  };
  explicit LiveFeed(Source source);
  ~LiveFeed();

  /// Nodes that have reported within a minute, by name, with the age of their last report.
  std::vector<NodeReport> nodes() const;
  /// Why nothing can be received; empty when all is well.
  std::string problem() const;

 private:
  struct Heard {
    wire::NodeStatus status;
    std::int64_t when_us = 0;
  };
  void listen();
  void receive_until_moved(runtime::Bus& bus, const std::string& identity);
  Source source_;
  mutable std::mutex mutex_;
  std::map<std::string, Heard> heard_;
  std::string problem_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace nacre::dashboard
