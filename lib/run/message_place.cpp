#include "run/message_place.hpp"

#include <algorithm>

#include "base/names.hpp"
#include "wire/channels.hpp"

namespace nacre::run {
namespace {

template <class Message>
std::optional<int> stated_round(const std::string& payload) {
  const auto message = wire::read<Message>(payload);
  if (!message || message->round < 0) return std::nullopt;
  return message->round;
}

}  // namespace

void ClosedRounds::close(int round, bool is_last) {
  newest_ = std::max(newest_, round);
  is_over_ = is_over_ || is_last;
}

std::optional<int> round_of(std::string_view channel, const std::string& payload) {
  if (channel == "ROUND") return stated_round<wire::RoundSummary>(payload);
  if (channel == "PARAMETERS") return stated_round<wire::AdoptedModel>(payload);
  if (channel == "GAMUT") return stated_round<wire::GamutChunk>(payload);
  if (channel == "PROPOSAL") return stated_round<wire::Proposal>(payload);
  if (channel == "MEASUREMENT") return stated_round<wire::Measurement>(payload);
  if (channel == "DIAGNOSIS") return stated_round<wire::Diagnosis>(payload);
  if (channel == "FAMILY") return stated_round<wire::CalibratedFamily>(payload);
  if (!wire::is_response(channel)) return std::nullopt;
  const std::string id = wire::request_id_of(channel, payload);
  if (const auto measured = number_between("analyser/r", "/measured", id)) return measured;
  return number_between("analyser/r", "/films", id);
}

int measured_in(const wire::Measurement& measured, const ClosedRounds& closed) {
  return measured.round >= 0 ? measured.round : closed.measuring();
}

}  // namespace nacre::run
