#pragma once
// A whole game in one process: the cores pass messages to each other through a queue, long work is done in between. No
// LCM, no clock; the order of delivery is a seeded choice, so that a game can be played shuffled and with repeats.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/processor_time.hpp"
#include "base/random.hpp"
#include "game/scenario.hpp"
#include "runtime/node_core.hpp"
#include "wire/convert.hpp"

namespace nacre::game_test {

/// How the bus treats messages and results of long work.
struct Delivery {
  std::uint64_t seed = 0;           ///< 0: in order
  double repeat_probability = 0.0;  ///< that a delivered message is delivered once more, later
};

class InProcessGame {
 public:
  explicit InProcessGame(const Delivery& delivery = {}) : delivery_(delivery), random_(delivery.seed, "delivery") {}

  void add(const std::string& node, std::unique_ptr<runtime::NodeCore> core,
           std::map<std::string, runtime::WorkFunction> work = {});

  /// Publishes a message as if someone outside had sent it.
  void publish(const runtime::Message& message);
  template <class Domain>
  void publish(const char* channel, const Domain& value) {
    publish(runtime::Message{channel, wire::write(value)});
  }
  /// Announces the run, with which everything begins.
  void announce(const game::Scenario& scenario);

  /// Delivers until nothing is left to deliver.
  void play();

  /// Everything that was published on a channel, in order; repeats of the same content once.
  template <class Domain>
  std::vector<Domain> sent(const std::string& channel) const {
    std::vector<Domain> all;
    for (const std::string& payload : payloads(channel)) all.push_back(wire::read<Domain>(payload).value());
    return all;
  }
  std::vector<std::string> payloads(const std::string& channel) const;
  /// Everything that was published, in order; repeats of the same content once.
  const std::vector<runtime::Message>& everything_sent() const { return sent_; }

  /// Channels and contents that equal games share (docs/ARCHITECTURE.md).
  std::set<std::pair<std::string, std::string>> essence() const;

  /// Ids of all long work asked for by `node`, with repeats.
  const std::vector<std::string>& work_of(const std::string& node) { return work_ids_[node]; }
  /// Warnings and errors that `node` logged.
  const std::vector<std::string>& complaints_of(const std::string& node) { return complaints_[node]; }
  /// Why `node` refused messages, in order.
  const std::vector<std::string>& refusals_of(const std::string& node) { return refusals_[node]; }
  /// What `node` would say again to a program that came later.
  std::vector<runtime::Message> open(const std::string& node, std::string_view channel) const {
    return nodes_.at(node).core->open(channel);
  }
  runtime::Status status_of(const std::string& node) const { return nodes_.at(node).core->status(); }

  /// Feeds everything that `node` received to a fresh core and compares what it sends. Returns the number of inputs.
  std::size_t replay(const std::string& node, runtime::NodeCore& fresh) const;

  /// Writes what `node` received and sent as its shell would have journaled it. Returns the number of records.
  std::int64_t write_journal(const std::string& node, const std::filesystem::path& file) const;

  /// Longest time that a core has computed within one step.
  double longest_step_s() const { return longest_step_s_; }

 private:
  struct Node {
    std::unique_ptr<runtime::NodeCore> core;
    std::map<std::string, runtime::WorkFunction> work;
  };
  struct Pending {
    std::string node;
    runtime::Input input;
  };
  void take_outputs(const std::string& node, runtime::Outputs outputs);

  Delivery delivery_;
  RandomStream random_;
  std::map<std::string, Node> nodes_;
  std::vector<Pending> pending_;
  std::vector<runtime::Message> sent_;
  std::set<std::pair<std::string, std::string>> known_contents_;
  std::map<std::string, std::vector<std::string>> work_ids_, complaints_, refusals_;
  std::map<std::string, std::vector<std::pair<runtime::Input, runtime::Outputs>>> journal_;
  double longest_step_s_ = 0.0;
};

}  // namespace nacre::game_test
