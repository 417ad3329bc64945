#include "wire/channels.hpp"

#include <algorithm>

#include "wire/convert.hpp"

namespace nacre::wire {
namespace {

template <class Domain>
Result<void> validate_domain(std::string_view payload) {
  const Result<Domain> value = read<Domain>(payload);
  if (!value) return tl::unexpected(value.error());
  return {};
}

template <class Type>
Result<void> validate_type(std::string_view payload) {
  const Result<Type> message = decode_safe<Type>(payload);
  if (!message) return tl::unexpected(message.error());
  return validate(*message);
}

using Receivers = std::vector<std::string_view>;

/// Row of a type that has a domain value.
template <class Domain>
Channel domain_channel(std::string_view name, Receivers receivers, bool synced = false) {
  using Wire = typename Domain::Wire;
  return {name, Wire::getTypeName(), Wire::getHash(), std::move(receivers), true, synced, validate_domain<Domain>};
}

/// Row of a type that is used as it is.
template <class Type>
Channel type_channel(std::string_view name, Receivers receivers, bool reliable = true, bool synced = false) {
  return {name, Type::getTypeName(), Type::getHash(), std::move(receivers), reliable, synced, validate_type<Type>};
}

std::vector<Channel> make_channels() {
  const Receivers validation{"validation_agent"};
  const Receivers everyone{kEveryNode};
  const Receivers judges{"validation_agent", "analyser"};
  return {
      type_channel<run_t>("RUN", everyone),
      domain_channel<AdoptedModel>("PARAMETERS", {"proposal_agent", "analyser"}),
      domain_channel<SimulateRequest>("SIMULATE", {"simulator_farm"}),
      domain_channel<SimulateResult>("SIMULATED", {kRequester}),
      domain_channel<Fracture>("FRACTURE", {kRequester}),
      domain_channel<GamutChunk>("GAMUT", {"analyser", "validation_agent"}),
      domain_channel<Proposal>("PROPOSAL", {"validation_agent", "analyser"}),
      type_channel<approval_t>("APPROVAL", validation, true, true),
      domain_channel<TestOrder>("TEST_ORDER", {"virtual_lab"}),
      domain_channel<Measurement>("MEASUREMENT", judges, true),
      type_channel<review_t>("REVIEW", judges, true, true),
      domain_channel<DiagnoseRequest>("DIAGNOSE", {"analyser"}),
      type_channel<diagnosis_t>("DIAGNOSIS", {"validation_agent", "proposal_agent"}),
      domain_channel<RoundSummary>("ROUND", everyone),
      domain_channel<CalibratedFamily>("FAMILY", {"analyser"}),
      domain_channel<FamilyGamut>("FAMILY_GAMUT", {"analyser"}),
      type_channel<ack_t>("ACK", everyone, false),
      type_channel<node_status_t>("STATUS", everyone, false),
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
  if (channel == "SIMULATE") {
    const Result<simulate_request_t> request = decode_safe<simulate_request_t>(payload);
    if (request) return request->request_id;
  } else if (channel == "SIMULATED") {
    const Result<simulate_result_t> response = decode_safe<simulate_result_t>(payload);
    if (response) return response->request_id;
  } else if (channel == "FRACTURE") {
    const Result<fracture_t> response = decode_safe<fracture_t>(payload);
    if (response) return response->request_id;
  }
  return {};
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
