#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <limits>

#include "../../instrumented.hpp"
#include "base/random.hpp"
#include "samples.hpp"
#include "wire/channels.hpp"
#include "wire/from_json.hpp"
#include "wire/header.hpp"
#include "wire/schema.hpp"

namespace nacre::wire {
namespace {

using testing::HasSubstr;

/// Caps the address space while it lives, so that a decoder which believes a hostile length fails the test.
class MemoryCap {
 public:
  explicit MemoryCap(rlim_t bytes) {
    getrlimit(RLIMIT_AS, &before_);
    rlimit capped = before_;
    capped.rlim_cur = bytes;
    if (!test::kIsInstrumented) setrlimit(RLIMIT_AS, &capped);
  }
  ~MemoryCap() {
    if (!test::kIsInstrumented) setrlimit(RLIMIT_AS, &before_);
  }

 private:
  rlimit before_{};
};

std::string corrupted(std::string bytes, RandomStream& random) {
  const int kind = random.index(4);
  const int edits = 1 + random.index(4);
  if (kind == 0) return bytes.substr(0, static_cast<std::size_t>(random.index(static_cast<int>(bytes.size()) + 1)));
  if (kind == 1)
    return bytes.insert(static_cast<std::size_t>(random.index(static_cast<int>(bytes.size()))), edits, '\xff');
  for (int i = 0; i < edits; ++i) {
    char& byte = bytes[random.index(static_cast<int>(bytes.size()))];
    byte = kind == 2 ? static_cast<char>(random.index(256)) : static_cast<char>(byte ^ (1 << random.index(8)));
  }
  return bytes;
}

TEST(Codec, CorruptedBytesNeverThrowNorTakeMemory) {
  for (const auto& [name, payload] : samples::payloads()) {
    const Channel* channel = find_channel(name);
    ASSERT_NE(channel, nullptr) << name;
    ASSERT_TRUE(channel->validate(payload)) << channel->validate(payload).error().message;
    RandomStream random(1, name);
    int accepted = 0;
    const MemoryCap cap(rlim_t{512} << 20);
    for (int i = 0; i < 20'000; ++i) {
      ASSERT_NO_THROW(accepted += channel->validate(corrupted(payload, random)).has_value()) << name;
    }
    EXPECT_LT(accepted, 16'000) << name;  // flipped digits of numbers are still numbers: the checksum is for those
  }
}

TEST(Codec, HostileCountsAreRefusedBeforeAnythingIsAllocated) {
  std::string payload = write(Ack{0, std::vector<std::string>(3, std::string(32, 'a')), {}});
  const std::size_t count = payload.size() - 3 * (4 + 33) - 4;
  for (const std::uint32_t length : {0x7fffffffu, 0xffffffffu, 0x80000000u, 100000u}) {
    for (int i = 0; i < 4; ++i)
      payload[count + static_cast<std::size_t>(i)] = static_cast<char>(length >> (24 - 8 * i));
    const MemoryCap cap(rlim_t{512} << 20);
    const auto read_back = read<Ack>(payload);
    ASSERT_FALSE(read_back);
    EXPECT_THAT(read_back.error().message, HasSubstr("hashes"));
  }
}

TEST(Codec, ArraysOfOneCountHaveOneLength) {
  Measurement measurement = samples::measurement();
  measurement.record.curve.stress_pa.pop_back();
  EXPECT_THROW(write(measurement), std::logic_error);
}

TEST(Codec, AnotherTypesBytesAreRefused) {
  EXPECT_FALSE(read<Review>(samples::payloads()[0].second));
  EXPECT_FALSE(read<Review>(""));
}

TEST(Codec, NumbersThatAreNotFiniteAndTrailingBytesAreRefused) {
  RoundSummary round;
  round.gap = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(read<RoundSummary>(write(round)));
  round.gap = 1.0;
  EXPECT_TRUE(read<RoundSummary>(write(round)));
  EXPECT_FALSE(read<RoundSummary>(write(round) + '\0'));
}

TEST(Codec, TextWithAZeroByteEndsThere) {
  Review review = samples::review();
  review.why = std::string("grip\0slip", 9);
  const auto read_back = read<Review>(write(review));
  ASSERT_TRUE(read_back) << read_back.error().message;
  EXPECT_EQ(read_back->why, "grip");
}

TEST(Schema, FollowsTheGeneratedTypes) {
  for (const auto& [name, payload] : samples::payloads()) {
    const auto json = to_json(find_channel(name)->type, payload);
    ASSERT_TRUE(json) << json.error().message;
    EXPECT_EQ(json->begin().key(), "header") << name;
  }
  EXPECT_EQ((*to_json("simulate_request_t", write(samples::request())))["designs"][1], "mix:0.65");
  EXPECT_FALSE(to_json("no_such_t", "12345678"));
}

TEST(Json, MakesTheSameMessageAgainToTheLastBit) {
  for (const auto& [name, payload] : samples::payloads()) {
    const std::string_view type = find_channel(name)->type;
    const std::string text = to_json(type, payload)->dump();
    const auto again = from_json(type, nlohmann::ordered_json::parse(text));
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(*again, payload) << name;
  }
}

TEST(Json, ThatIsNoMessageIsRefusedWithItsMember) {
  const auto message = *to_json("proposal_t", write(samples::proposal()));
  const auto refusal = [&](const char* pointer, const nlohmann::ordered_json& value) {
    nlohmann::ordered_json wrong = message;
    wrong[nlohmann::ordered_json::json_pointer(pointer)] = value;
    const auto refused = from_json("proposal_t", wrong);
    return refused ? std::string() : refused.error().message;
  };
  EXPECT_EQ(refusal("/round", message["round"]), "");
  EXPECT_THAT(refusal("/round", 1.5), HasSubstr("round: expected a whole number"));
  EXPECT_THAT(refusal("/round", std::int64_t{1} << 40), HasSubstr("round: expected a whole number from -2147483648"));
  EXPECT_THAT(refusal("/designs/0/modulus_pa", "much"), HasSubstr("designs[0].modulus_pa: expected a number"));
  EXPECT_THAT(refusal("/designs/0/design", std::string(3, '\0')), HasSubstr("designs[0].design: expected a text"));
  EXPECT_THAT(refusal("/designs", nlohmann::ordered_json::array()), HasSubstr("designs: expected an array of"));
  EXPECT_THAT(refusal("/strange", 1), HasSubstr("members"));
  EXPECT_FALSE(from_json("no_such_t", message));
}

TEST(Schema, NamesTheFirstFieldThatDiffers) {
  Proposal a = samples::proposal(), b = a;
  EXPECT_FALSE(first_difference("proposal_t", write(a), write(b)));
  b.designs[0].modulus_pa = 3e9;
  EXPECT_EQ(*first_difference("proposal_t", write(a), write(b)),
            "designs[0].modulus_pa: 1000000000 against 3000000000");
}

TEST(Header, ComesOffAsItWasStamped) {
  for (const auto& [channel, payload] : samples::payloads()) {
    const Header header{123, "validation_agent", 456, 7, "run-1"};
    const auto blanked = blank_header(channel, stamp_header(channel, payload, header));
    ASSERT_TRUE(blanked);
    EXPECT_EQ(blanked->header, header);
    EXPECT_EQ(blanked->payload, payload);
  }
}

TEST(Header, EverySingleFlippedBitIsFound) {
  const std::string bytes = stamp_header("ROUND", write(samples::round()), {1, "validation_agent", 2, 3, "run-1"});
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string damaged = bytes;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    EXPECT_FALSE(blank_header("ROUND", damaged)) << "bit " << bit;
  }
  EXPECT_FALSE(blank_header("REVIEW", bytes));  // the channel belongs to it
}

TEST(Header, DoesNotTouchTheIdentityOfAMessage) {
  const std::string payload = write(samples::round());
  const auto once = blank_header("ROUND", stamp_header("ROUND", payload, {1, "a", 2, 3, "run-1"}));
  const auto again = blank_header("ROUND", stamp_header("ROUND", payload, {9, "b", 9, 9, "run-1"}));
  EXPECT_EQ(message_hash("ROUND", once->payload), message_hash("ROUND", again->payload));
  EXPECT_NE(message_hash("ROUND", payload), message_hash("RUN", payload));
}

}  // namespace
}  // namespace nacre::wire
