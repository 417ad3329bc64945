#include "runtime/endpoint.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "wire/channels.hpp"
#include "wire/convert.hpp"

namespace nacre::runtime {

Endpoint::Endpoint(std::unique_ptr<Bus> bus, std::string node, std::vector<std::string> participants)
    : bus_(std::move(bus)), node_(std::move(node)), participants_(std::move(participants)) {}

Result<std::unique_ptr<Endpoint>> Endpoint::open(BusOptions options, std::vector<std::string> participants,
                                                 std::vector<std::string> channels) {
  std::string node = options.node;
  Result<std::unique_ptr<Bus>> bus = Bus::open(std::move(options));
  if (!bus) return tl::unexpected(bus.error());
  channels.insert(channels.end(), {"STATUS", "ACK"});
  std::ranges::sort(channels);
  channels.erase(std::unique(channels.begin(), channels.end()), channels.end());
  if (const Result<void> listening = (*bus)->subscribe(channels); !listening) return tl::unexpected(listening.error());
  return std::unique_ptr<Endpoint>(new Endpoint(std::move(*bus), std::move(node), std::move(participants)));
}

Result<std::string> Endpoint::offer(const Message& message) {
  if (const Result<void> sound = wire::check_outgoing(message.channel, message.payload); !sound) {
    return tl::unexpected(sound.error());
  }
  const Parcel parcel = parcel_of(message, std::ssize(offered_), participants_, node_);
  offered_.push_back(message);
  outbox_.offer(parcel);
  return parcel.hash;
}

void Endpoint::pump(int timeout_ms, const std::function<void(const Received&)>& handler) {
  const std::int64_t end = steady_us() + std::int64_t{1000} * timeout_ms;
  std::int64_t now = steady_us();
  do {
    for (const std::int64_t place : outbox_.due(now)) bus_->publish(offered_.at(place));
    const std::int64_t until = std::min(end, outbox_.next_due().value_or(end));
    const int wait_ms = static_cast<int>(std::max<std::int64_t>(0, (until - now + 999) / 1000));
    bus_->receive(wait_ms, [&](const Received& received) {
      handle(received);
      if (handler) handler(received);
    });
    now = steady_us();
  } while (now < end);
}

bool Endpoint::deliver(double timeout_s, const std::function<void(const Received&)>& handler) {
  const std::int64_t end = steady_us() + static_cast<std::int64_t>(1e6 * timeout_s);
  while (outbox_.unacknowledged() > 0 && steady_us() < end) pump(20, handler);
  return outbox_.unacknowledged() == 0;
}

std::optional<std::string> Endpoint::refusal_of(const std::string& hash) const {
  const auto found = refusals_.find(hash);
  return found == refusals_.end() ? std::nullopt : std::optional(found->second);
}

void Endpoint::handle(const Received& received) {
  if (received.message.channel == "STATUS") {
    const auto status = wire::read<wire::NodeStatus>(received.message.payload);
    if (status) outbox_.saw(received.header.node, received.header.epoch, status->journal);
  } else if (received.message.channel == "ACK") {
    const auto ack = wire::read<wire::Ack>(received.message.payload);
    if (!ack) return;
    for (const std::string& hash : ack->hashes)
      outbox_.acknowledge(hash, received.header.node, received.header.epoch, ack->journal);
    for (const wire::Refusal& refusal : ack->refused)
      if (outbox_.knows(refusal.hash)) refusals_.emplace(refusal.hash, refusal.reason);
  }
}

}  // namespace nacre::runtime
