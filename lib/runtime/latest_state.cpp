#include "runtime/latest_state.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "wire/channels.hpp"
#include "wire/convert.hpp"
#include "wire/header.hpp"

namespace nacre::runtime {
namespace {

/// What there is one message of, and its round: of an older round it replaces nothing.
struct Place {
  std::string what;
  int round = 0;
};

template <class Message, class Describe>
std::optional<Place> place_in(const std::string& payload, const Describe& describe) {
  const auto message = wire::read<Message>(payload);
  if (!message) return std::nullopt;
  return describe(*message);
}

std::optional<Place> place_of(const std::string& channel, const wire::Blanked& message) {
  const std::string& payload = message.payload;
  const auto of_round = [](const auto& m) { return Place{"", m.round}; };
  if (channel == "STATUS") return Place{message.header.node, 0};
  if (channel == "RUN" || channel == "REVEAL") return Place{};
  if (channel == "PARAMETERS") return place_in<wire::AdoptedModel>(payload, of_round);
  if (channel == "PROPOSAL") return place_in<wire::Proposal>(payload, of_round);
  if (channel == "DIAGNOSIS") return place_in<wire::Diagnosis>(payload, of_round);
  if (channel == "ROUND") return place_in<wire::RoundSummary>(payload, of_round);
  if (channel == "GAMUT")
    return place_in<wire::GamutChunk>(payload, [](const auto& m) {
      return Place{fmt::format("{}/{}", m.round, m.chunk), m.round};
    });
  if (channel == "TEST_ORDER")
    return place_in<wire::TestOrder>(payload, [](const auto& m) { return Place{m.order_id, m.round}; });
  if (channel == "FAMILY")
    return place_in<wire::CalibratedFamily>(payload, [](const auto& m) {
      return Place{std::to_string(m.number), m.round};
    });
  if (channel == "FAMILY_GAMUT")
    return place_in<wire::FamilyGamut>(payload, [](const auto& m) {
      return Place{fmt::format("{}/{}", m.number, m.chunk), 0};
    });
  return std::nullopt;
}

/// Whether a GAMUT holds a gamut without a base: those of earlier rounds are no part of the newest.
bool begins_a_gamut(const std::string& payload) {
  const auto chunk = wire::read<wire::GamutChunk>(payload);
  return chunk && chunk->base < 0;
}

}  // namespace

void LatestState::take(const std::string& channel, const std::string& bytes) {
  if (wire::find_channel(channel) == nullptr) return;
  const auto message = wire::blank_header(channel, bytes);
  if (!message) return;
  const auto place = place_of(channel, *message);
  if (!place) return;
  Kept& known = kept_[{channel, place->what}];
  if (!known.bytes.empty() && known.round > place->round) return;
  known = {channel, bytes, place->round, ++taken_};
  if (channel == "GAMUT" && begins_a_gamut(message->payload)) forget("GAMUT", place->round);
  if (channel == "ROUND") forget("TEST_ORDER", place->round + 1);
}

void LatestState::forget(const std::string& channel, int before_round) {
  std::erase_if(kept_,
                [&](const auto& each) { return each.first.first == channel && each.second.round < before_round; });
}

std::vector<LatestState::Kept> LatestState::messages() const {
  std::vector<Kept> messages;
  for (const auto& [place, kept] : kept_) messages.push_back(kept);
  std::ranges::sort(messages, {}, &Kept::order);
  return messages;
}

}  // namespace nacre::runtime
