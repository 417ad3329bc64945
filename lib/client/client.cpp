#include "client/client.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <set>
#include <utility>

#include <fmt/ranges.h>

#include "game/scenario.hpp"
#include "runtime/endpoint.hpp"
#include "runtime/run_folder.hpp"
#include "wire/channels.hpp"
#include "wire/convert.hpp"
#include "wire/from_json.hpp"
#include "wire/schema.hpp"

namespace nacre::client {
namespace {

constexpr const char* kOrders = "TEST_ORDER";
constexpr const char* kMeasurements = "MEASUREMENT";
constexpr const char* kRounds = "ROUND";
constexpr double kTurnS = 0.05;
constexpr double kFirstAskS = 1.0, kLastAskS = 60.0;  ///< between questions for what is open
constexpr double kSilenceS = 60.0;
constexpr double kFollowS = 3.0;  ///< of silence, after which the run may have gone on at another port

Order order_of(wire::TestOrder message) {
  return {.round = message.round,
          .id = std::move(message.order_id),
          .design = std::move(message.design),
          .test = message.test,
          .fidelity = message.fidelity,
          .replicates = message.replicates,
          .conditions = message.conditions,
          .loading = std::move(message.loading),
          .batch = std::move(message.batch),
          .reason = std::move(message.reason)};
}

Heard heard(const runtime::Received& received) {
  const wire::Channel& channel = *wire::find_channel(received.message.channel);
  auto json = wire::to_json(channel.type, received.message.payload).value();  // the bus has checked it
  json.erase("header");
  return {received.message.channel, received.header.node, received.header.utime, json.dump()};
}

std::unique_ptr<runtime::Endpoint> join(const std::filesystem::path& folder, const runtime::Manifest& manifest,
                                        const std::string& name, const std::set<std::string>& channels) {
  const std::vector<std::string> nodes = game::read_scenario(folder / "scenario.toml").nodes();
  if (name.empty() || std::ranges::count(nodes, name) > 0)
    throw InputError::format("\"{}\" cannot be the name of a client: expected one that no node of the run has", name);
  for (const std::string& channel : channels)
    if (!wire::find_channel(channel)) throw InputError::format("there is no channel {}", channel);
  runtime::BusOptions options;
  options.url = runtime::bus_url(manifest.port, manifest.lan);
  options.node = name;
  options.run_id = manifest.run_id;
  options.faults = runtime::faults_from_environment();
  auto endpoint = runtime::Endpoint::open(std::move(options), nodes, {channels.begin(), channels.end()});
  if (!endpoint) throw InputError(endpoint.error().message);
  return std::move(*endpoint);
}

}  // namespace

struct Client::State {
  std::filesystem::path run;
  std::string name;
  std::set<std::string> wanted;  ///< channels of listen()
  int port = 0;
  std::unique_ptr<runtime::Endpoint> endpoint;
  std::set<std::string> known;  ///< hashes of what came in, STATUS and the like aside
  std::deque<Order> orders;
  std::deque<Heard> heard;
  bool is_over = false;
  double silence_s = 0.0;     ///< spent waiting since a node was last heard
  double unfollowed_s = 0.0;  ///< of it, since the manifest was read
  double ask_after_s = 0.0, next_pause_s = kFirstAskS;

  /// Joins the run where its manifest says that it is.
  void enter() {
    const runtime::Manifest manifest = runtime::read_manifest(run);
    if (endpoint && manifest.port == port) return;
    std::set<std::string> channels = wanted;
    channels.insert({kOrders, kRounds});
    endpoint = join(run, manifest, name, channels);
    port = manifest.port;
    ask_again_soon();
  }

  void follow() {
    unfollowed_s = 0.0;
    try {
      enter();
    } catch (const InputError&) {
      // The folder cannot be read now: the endpoint that there is stays, and silence ends the game.
    }
  }

  void take(const runtime::Received& received) {
    silence_s = unfollowed_s = 0.0;
    const auto& [channel, payload] = received.message;
    const bool is_reliable = wire::find_channel(channel)->reliable;
    if (is_reliable && !known.insert(wire::message_hash(channel, payload)).second) return;
    if (channel == kOrders) orders.push_back(order_of(wire::read<wire::TestOrder>(payload).value()));
    if (channel == kRounds) {
      is_over = is_over || wire::read<wire::RoundSummary>(payload)->last;
      ask_again_soon();  // the orders of the next one follow
    }
    if (channel == "STATUS" && received.header.node == "validation_agent")
      is_over = is_over || wire::read<wire::NodeStatus>(payload)->finished;
    if (wanted.contains(channel)) heard.push_back(client::heard(received));
  }

  void ask_again_soon() {
    ask_after_s = 0.0;
    next_pause_s = kFirstAskS;
  }

  /// What the answer holds, or the answer, may be lost: the question is put again, less and less often.
  void ask() {
    ask_after_s = next_pause_s;
    next_pause_s = std::min(2.0 * next_pause_s, kLastAskS);
    for (const std::string_view channel : wire::Ask::kChannels)
      if (channel == kOrders || wanted.contains(std::string(channel)))
        endpoint->bus().publish({"ASK", wire::write(wire::Ask{std::string(channel)})});
  }

  /// Takes in what arrives until `enough` or until wait_s is over, at least for one turn.
  void wait(double wait_s, const std::function<bool()>& enough) {
    for (double waited_s = 0.0; !enough() && (waited_s == 0.0 || waited_s < wait_s); waited_s += kTurnS) {
      if (ask_after_s <= 0.0) ask();
      ask_after_s -= kTurnS;
      silence_s += kTurnS;
      unfollowed_s += kTurnS;
      if (unfollowed_s > kFollowS) follow();
      endpoint->pump(static_cast<int>(1e3 * kTurnS), [this](const runtime::Received& received) { take(received); });
    }
  }

  Result<void> deliver(const runtime::Message& message, double patience_s) {
    if (silence_s > kFollowS) follow();
    const Result<std::string> hash = endpoint->offer(message);
    if (!hash) return tl::unexpected(hash.error());
    endpoint->deliver(patience_s, [this](const runtime::Received& received) { take(received); });
    if (const std::set<std::string> missing = endpoint->waiting_for(*hash); !missing.empty())
      return fail("{} did not answer within {} s", fmt::join(missing, ", "), patience_s);
    if (const auto refusal = endpoint->refusal_of(*hash)) return fail("{}", *refusal);
    return {};
  }
};

Client::Client(const std::filesystem::path& run, const std::string& name, const std::vector<std::string>& channels)
    : state_(std::make_unique<State>()) {
  state_->run = run;
  state_->name = name;
  state_->wanted = {channels.begin(), channels.end()};
  state_->enter();
}

Client::~Client() = default;
Client::Client(Client&&) noexcept = default;

bool Client::is_playing() const { return !state_->is_over && state_->silence_s < kSilenceS; }

std::vector<Order> Client::orders(double wait_s) {
  state_->wait(wait_s, [this] { return !state_->orders.empty() || state_->is_over; });
  const auto orders = std::exchange(state_->orders, {});
  return {orders.begin(), orders.end()};
}

Result<void> Client::report(const Order& order, const measurement::SpecimenRecord& specimen, double patience_s) {
  const wire::Measurement measurement{
      .round = order.round, .order_id = order.id, .fidelity = order.fidelity, .record = wire::fit_to_send(specimen)};
  return state_->deliver({kMeasurements, wire::write(measurement)}, patience_s);
}

Result<void> Client::send(const std::string& channel, const std::string& json, double patience_s) {
  const wire::Channel* known = wire::find_channel(channel);
  if (!known || !known->reliable) return fail("{} is no channel of messages that are acknowledged", channel);
  auto fields = nlohmann::ordered_json::parse(json, nullptr, false);
  if (!fields.is_object()) return fail("{}: not a JSON object: {}", channel, json);
  fields["header"] = {{"utime", 0}, {"node", ""}, {"epoch", 0}, {"seq", 0}, {"checksum", 0}, {"run_id", ""}};
  const Result<std::string> payload = wire::from_json(known->type, fields);
  if (!payload) return tl::unexpected(payload.error());
  return state_->deliver({channel, *payload}, patience_s);
}

void Client::listen(double wait_s, const std::function<void(const Heard&)>& hear) {
  const auto hand_over = [&] {
    for (; !state_->heard.empty(); state_->heard.pop_front()) hear(state_->heard.front());
    return false;
  };
  state_->wait(wait_s, hand_over);
  hand_over();
}

}  // namespace nacre::client
