#include "dashboard/live_feed.hpp"

#include <unistd.h>

#include "base/result.hpp"
#include "wire/convert.hpp"

namespace nacre::dashboard {
namespace {

constexpr double kForgotten_s = 60.0;
constexpr int kTurn_ms = 100, kTurnsBetweenLooks = 20;
constexpr int kPause_ms = 2000;

double seconds_since(std::int64_t when_us) { return 1e-6 * static_cast<double>(runtime::steady_us() - when_us); }

}  // namespace

LiveFeed::LiveFeed(Source source) : source_(std::move(source)), thread_([this] { listen(); }) {}

LiveFeed::~LiveFeed() {
  stopping_ = true;
  thread_.join();
}

std::vector<NodeReport> LiveFeed::nodes() const {
  const std::lock_guard lock(mutex_);
  std::vector<NodeReport> reports;
  for (const auto& [node, heard] : heard_) {
    const double age_s = seconds_since(heard.when_us);
    if (age_s < kForgotten_s) reports.push_back({node, heard.status, age_s});
  }
  return reports;
}

std::string LiveFeed::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

void LiveFeed::take_result(const std::string& payload) {
  if (const auto result = wire::read<wire::SimulateResult>(payload)) search_.take(*result);
}

void LiveFeed::receive_until_moved(runtime::Bus& bus, const std::string& identity) {
  for (int turn = 1; !stopping_; ++turn) {
    bus.receive(kTurn_ms, [&](const runtime::Received& received) {
      if (received.message.channel == "SIMULATED") return take_result(received.message.payload);
      const auto status = wire::read<wire::NodeStatus>(received.message.payload);
      if (!status) return;
      const std::lock_guard lock(mutex_);
      heard_[received.header.node] = {*status, runtime::steady_us()};
    });
    if (turn % kTurnsBetweenLooks == 0 && source_.identity() != identity) return;
  }
}

void LiveFeed::listen() {
  while (!stopping_) {
    try {
      const std::string identity = source_.identity();
      const auto bus = source_.open();
      {
        const std::lock_guard lock(mutex_);
        problem_.clear();
      }
      source_.recorded([this](const std::string& payload) { take_result(payload); });
      receive_until_moved(*bus, identity);
    } catch (const std::exception& error) {
      const std::lock_guard lock(mutex_);
      problem_ = error.what();
    }
    for (int waited = 0; waited < kPause_ms && !stopping_; waited += kTurn_ms) ::usleep(1000 * kTurn_ms);
  }
}

}  // namespace nacre::dashboard
