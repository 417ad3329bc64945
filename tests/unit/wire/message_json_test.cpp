// Messages as JSON against the schemas that describe them.

#include "wire/message_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../json_schema_check.hpp"
#include "samples.hpp"
#include "wire/channels.hpp"

namespace nacre::wire {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(MessageJson, EverySampleIsAsItsSchemaSays) {
  for (const auto& [name, payload] : samples::payloads()) {
    const Channel& channel = *find_channel(name);
    const auto message = channel.to_json(payload);
    ASSERT_TRUE(message) << message.error().message;
    EXPECT_THAT(*message, Not(IsEmpty())) << name;
    EXPECT_THAT(schema_fault(channel.schema(), *message), IsEmpty()) << name;
  }
}

TEST(MessageJson, AMemberOfAnotherTypeOrOutOfRangeContradictsTheSchema) {
  const Channel& channel = *find_channel("PROPOSAL");
  const Json sound = *channel.to_json(write(samples::proposal()));
  const auto fault_with = [&](const char* pointer, const Json& value) {
    Json altered = sound;
    altered[Json::json_pointer(pointer)] = value;
    return schema_fault(channel.schema(), altered);
  };
  EXPECT_THAT(fault_with("/round", "one"), HasSubstr("round"));
  EXPECT_THAT(fault_with("/round", 0.5), HasSubstr("round"));
  EXPECT_THAT(fault_with("/designs/0/modulus_pa", -1.0), HasSubstr("modulus_pa"));
  EXPECT_THAT(fault_with("/header", Json::object()), HasSubstr("utime"));
  EXPECT_THAT(fault_with("/noise", 1), HasSubstr("noise"));
  Json shortened = sound;
  shortened.erase("fidelity");
  EXPECT_THAT(schema_fault(channel.schema(), shortened), HasSubstr("fidelity"));
}

/// Members whose type a viewer does not take: it knows one type per member, and no arrays in arrays.
std::vector<std::string> unusual_members(const Json& schema, const std::string& place) {
  std::vector<std::string> found;
  for (const auto& [name, member] : schema["properties"].items()) {
    const bool is_array = member["type"] == "array";
    const Json& one = is_array ? member["items"] : member;
    if (!one["type"].is_string() || one["type"] == "array" || one["type"] == "null") found.push_back(place + name);
    if (one["type"] != "object") continue;
    for (std::string& inner : unusual_members(one, place + name + ".")) found.push_back(std::move(inner));
  }
  return found;
}

TEST(MessageJson, SchemasKeepToWhatViewersTake) {
  for (const Channel& channel : channels()) {
    const Json schema = channel.schema();
    EXPECT_EQ(schema["type"], "object");
    EXPECT_GT(schema["properties"].size(), 1U) << channel.name;
    EXPECT_THAT(unusual_members(schema, ""), IsEmpty()) << channel.name;
  }
}

TEST(MessageJson, ValuesAreThoseOfTheMessage) {
  const Json proposal = *find_channel("PROPOSAL")->to_json(write(samples::proposal()));
  EXPECT_EQ(proposal["designs"][0]["design"], samples::proposal().designs[0].design.name());
  const GamutChunk chunk = samples::gamut();
  const Json gamut = *find_channel("GAMUT")->to_json(write(chunk));
  ASSERT_EQ(gamut["modulus_pa"].size(), chunk.samples.size());
  for (std::size_t i = 0; i < chunk.samples.size(); ++i) {
    EXPECT_EQ(gamut["pattern"][i], chunk.samples[i].pattern.key()) << "a number would lose bits in JavaScript";
    EXPECT_EQ(gamut["modulus_pa"][i], chunk.samples[i].performance.modulus_pa);
  }
  EXPECT_EQ(find_channel("SIMULATE")->to_json(write(samples::request())).value()["tests"], 3);
}

TEST(MessageJson, WhatIsAbsentHasNoMember) {
  Diagnosis diagnosis = samples::diagnosis();
  EXPECT_TRUE(find_channel("DIAGNOSIS")->to_json(write(diagnosis))->contains("gain"));
  diagnosis.gain.reset();
  const Json without = *find_channel("DIAGNOSIS")->to_json(write(diagnosis));
  EXPECT_FALSE(without.contains("gain"));
  EXPECT_THAT(schema_fault(find_channel("DIAGNOSIS")->schema(), without), IsEmpty());
}

TEST(MessageJson, WhatCannotBeReadIsAnError) {
  const auto message = find_channel("PROPOSAL")->to_json(write(samples::status()));
  ASSERT_FALSE(message);
  EXPECT_THAT(message.error().message, HasSubstr("proposal_t"));
}

}  // namespace
}  // namespace nacre::wire
