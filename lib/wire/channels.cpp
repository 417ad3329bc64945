#include "wire/channels.hpp"

#include <algorithm>

#include "wire/convert.hpp"
#include "wire/message_json.hpp"
#include "wire/schema.hpp"

namespace nacre::wire {
namespace {

using Receivers = std::vector<std::string_view>;

template <class Message>
Result<void> validate(std::string_view payload) {
  const Result<Message> message = read<Message>(payload);
  if (!message) return tl::unexpected(message.error());
  return {};
}

template <class Message>
Channel channel(std::string_view name, Receivers receivers, bool reliable = true, bool synced = false) {
  using Wire = typename Message::Wire;
  return {.name = name,
          .type = Wire::getTypeName(),
          .fingerprint = Wire::getHash(),
          .receivers = std::move(receivers),
          .reliable = reliable,
          .synced = synced,
          .validate = validate<Message>,
          .schema = schema_of_message<Message>,
          .to_json = json_of_message<Message>};
}

std::vector<Channel> make_channels() {
  const Receivers validation{"validation_agent"};
  const Receivers everyone{kEveryNode};
  const Receivers judges{"validation_agent", "analyser"};
  return {
      channel<RunStart>("RUN", everyone),
      channel<AdoptedModel>("PARAMETERS", {"proposal_agent", "analyser"}),
      channel<SimulateRequest>("SIMULATE", {"simulator_farm"}),
      channel<SimulateResult>("SIMULATED", {kRequester}),
      channel<Fracture>("FRACTURE", {kRequester}),
      channel<GamutChunk>("GAMUT", {"analyser", "validation_agent"}),
      channel<Proposal>("PROPOSAL", {"validation_agent", "analyser"}),
      channel<Approval>("APPROVAL", validation, true, true),
      channel<TestOrder>("TEST_ORDER", {"virtual_lab"}),
      channel<Measurement>("MEASUREMENT", judges, true, true),
      channel<Review>("REVIEW", judges, true, true),
      channel<DiagnoseRequest>("DIAGNOSE", {"analyser"}),
      channel<Diagnosis>("DIAGNOSIS", {"validation_agent", "proposal_agent"}),
      channel<RoundSummary>("ROUND", everyone),
      channel<CalibratedFamily>("FAMILY", {"analyser"}),
      channel<FamilyGamut>("FAMILY_GAMUT", {"analyser"}),
      channel<Ack>("ACK", everyone, false),
      channel<NodeStatus>("STATUS", everyone, false),
      channel<Reveal>("REVEAL", {"analyser"}),
      channel<Ask>("ASK", validation, false),
      channel<Withdrawal>("WITHDRAWAL", validation, true, true),
  };
}

bool contains(const Receivers& receivers, std::string_view name) {
  return std::ranges::find(receivers, name) != receivers.end();
}

}  // namespace

std::span<const Channel> channels() {
  static const std::vector<Channel> table = make_channels();
  return table;
}

const Channel* find_channel(std::string_view name) {
  for (const Channel& channel : channels()) {
    if (channel.name == name) return &channel;
  }
  return nullptr;
}

bool listens(const Channel& channel, std::string_view node) {
  return contains(channel.receivers, kEveryNode) || contains(channel.receivers, kRequester) ||
         contains(channel.receivers, node);
}

bool is_meant_for(const Channel& channel, std::string_view payload, std::string_view node) {
  if (!contains(channel.receivers, kRequester)) return listens(channel, node);
  return requester_of(request_id_of(channel.name, payload)) == node;
}

std::vector<std::string> receivers_of(const Channel& channel, std::string_view payload,
                                      std::span<const std::string> participants, std::string_view sender) {
  std::vector<std::string> receivers;
  for (const std::string& node : participants) {
    if (node != sender && is_meant_for(channel, payload, node)) receivers.push_back(node);
  }
  return receivers;
}

Result<void> check_outgoing(std::string_view channel, std::string_view payload) {
  const Channel* known = find_channel(channel);
  if (!known) return fail("there is no channel {}", channel);
  if (payload.size() > kMaximumBlankPayload) {
    return fail("a message of {} bytes on {}, at most {}", payload.size(), channel, kMaximumBlankPayload);
  }
  return known->validate(payload);
}

std::string request_id_of(std::string_view channel, std::string_view payload) {
  if (channel != "SIMULATE" && channel != "SIMULATED" && channel != "FRACTURE") return {};
  const Channel* known = find_channel(channel);
  const Result<std::string_view> fields = behind_header(known->type, known->fingerprint, payload);
  std::string request_id;  // their first field
  if (!fields) return request_id;
  FieldReader reader(*fields);
  reader("request_id", request_id);
  return request_id;
}

bool is_response(std::string_view channel) {
  const Channel* known = find_channel(channel);
  return known != nullptr && contains(known->receivers, kRequester);
}

std::string_view requester_of(std::string_view request_id) {
  const std::size_t slash = request_id.find('/');
  return slash == std::string_view::npos ? std::string_view() : request_id.substr(0, slash);
}

std::string place_of(std::string_view request_id) { return std::string(request_id.substr(0, request_id.find('#'))); }

}  // namespace nacre::wire
