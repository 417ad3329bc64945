#include "runtime/bus.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/sequence.hpp"
#include "wire/convert.hpp"

namespace nacre::runtime {
namespace {

using testing::HasSubstr;

Message review(const std::string& specimen) {
  wire::Review message;
  message.specimen = specimen;
  return {"REVIEW", wire::write(message)};
}

struct MemoryBus {
  std::vector<std::string> reports;
  std::unique_ptr<Bus> bus;

  explicit MemoryBus(FaultSettings faults = {}, std::vector<std::string> channels = {}) {
    BusOptions options;
    options.url = "memq://";
    options.node = "analyser";
    options.run_id = "run-1";
    options.epoch = 42;
    options.faults = faults;
    options.report = [this](LogLevel, const std::string& text) { reports.push_back(text); };
    bus = std::move(*Bus::open(std::move(options)));
    EXPECT_TRUE(bus->subscribe(channels));
  }

  std::vector<Received> receive_all() {
    std::vector<Received> all;
    while (bus->receive(1, [&](const Received& received) { all.push_back(received); }) > 0) {
    }
    return all;
  }
};

TEST(Bus, DeliversWhatWasSentWithItsHeader) {
  MemoryBus memory;
  ASSERT_TRUE(memory.bus->publish(review("S-1")));
  const auto all = memory.receive_all();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].message, review("S-1"));
  EXPECT_EQ(all[0].header.node, "analyser");
  EXPECT_EQ(all[0].header.epoch, 42);
  EXPECT_EQ(all[0].header.seq, 1);
}

TEST(Bus, TakesABurstWithoutLoss) {
  MemoryBus memory;
  for (int i = 0; i < 2000; ++i) ASSERT_TRUE(memory.bus->publish(review("S-" + std::to_string(i))));
  EXPECT_EQ(memory.receive_all().size(), 2000u);
  EXPECT_EQ(memory.bus->counters().lost, 0);
}

TEST(Bus, ForeignDamagedAndInvalidMessagesAreCountedNamedOnceAndDropped) {
  MemoryBus memory;
  const std::string sound = wire::stamp_header("REVIEW", review("S-1").payload, {1, "b", 2, 3, "run-1"});
  std::string damaged = sound;
  damaged[sound.size() - 10] = static_cast<char>(damaged[sound.size() - 10] ^ 1);
  for (int i = 0; i < 3; ++i) {
    memory.bus->publish_raw("REVIEW", damaged);
    memory.bus->publish_raw("REVIEW", wire::stamp_header("REVIEW", review("S-1").payload, {1, "b", 2, 3, "run-2"}));
    memory.bus->publish_raw("REVIEW", "");
    memory.bus->publish_raw("REVIEW", std::string(70'000, 'x'));
    memory.bus->publish_raw("OTHER", sound);
    memory.bus->publish_raw("ROUND", sound);
    memory.bus->publish_raw("REVIEW", wire::stamp_header("REVIEW", review("").payload, {1, "b", 2, 3, "run-1"}));
  }
  EXPECT_TRUE(memory.receive_all().empty());
  EXPECT_EQ(memory.bus->counters().corrupt, 6);
  EXPECT_EQ(memory.bus->counters().foreign, 12);
  EXPECT_EQ(memory.bus->counters().invalid, 3);
  EXPECT_EQ(memory.reports.size(), 14u);  // seven kinds, at counts 1 and 2
  EXPECT_THAT(memory.reports, testing::Contains(HasSubstr("run \"run-2\" from b")));
  EXPECT_THAT(memory.reports, testing::Contains(HasSubstr("specimen")));
}

TEST(Bus, EveryReasonAndSenderOfARefusedMessageIsNamed) {
  MemoryBus memory;
  const auto send = [&](const std::string& node, const std::string& payload) {
    memory.bus->publish_raw("REVIEW", wire::stamp_header("REVIEW", payload, {1, node, 2, 3, "run-1"}));
  };
  wire::Review negative;
  negative.specimen = "S-1";
  negative.revision = -1;
  for (int i = 0; i < 3; ++i) send("a", review("").payload);
  send("b", review("").payload);
  send("a", wire::write(negative));
  EXPECT_TRUE(memory.receive_all().empty());
  ASSERT_EQ(memory.reports.size(), 4u);
  EXPECT_THAT(memory.reports[0], HasSubstr("from a dropped"));
  EXPECT_THAT(memory.reports[1], HasSubstr("2 times so far"));
  EXPECT_THAT(memory.reports[2], HasSubstr("from b dropped"));
  EXPECT_THAT(memory.reports[3], HasSubstr("revision"));
}

TEST(Bus, WhatIsDroppedForItsRunIsNotLost) {
  MemoryBus memory;
  for (const std::int64_t seq : {1, 2, 3, 4}) {
    const std::string run = seq % 2 == 0 ? "run-2" : "run-1";
    memory.bus->publish_raw("REVIEW", wire::stamp_header("REVIEW", review("S-1").payload, {1, "b", 2, seq, run}));
  }
  EXPECT_EQ(memory.receive_all().size(), 2u);
  EXPECT_EQ(memory.bus->counters().foreign, 2);
  EXPECT_EQ(memory.bus->counters().lost, 0);
}

TEST(Bus, AFloodOfDifferentProblemsFillsNoLogAndHidesNoOtherKind) {
  MemoryBus memory;
  for (int i = 0; i < 5000; ++i) memory.bus->publish_raw("CHANNEL_" + std::to_string(i), "bytes");
  EXPECT_TRUE(memory.receive_all().empty());
  EXPECT_LT(memory.reports.size(), 120u);
  EXPECT_THAT(memory.reports.back(), HasSubstr("others like it so far"));
  memory.bus->publish_raw("REVIEW", wire::stamp_header("REVIEW", review("").payload, {1, "b", 2, 3, "run-1"}));
  EXPECT_TRUE(memory.receive_all().empty());
  EXPECT_THAT(memory.reports.back(), HasSubstr("a message on REVIEW from b dropped"));
}

TEST(Bus, AMessageThatIsTooLongIsNotSent) {
  MemoryBus memory;
  EXPECT_FALSE(memory.bus->publish({"REVIEW", std::string(60'001, 'x')}));
  EXPECT_THAT(memory.reports.at(0), HasSubstr("at most 60000"));
}

TEST(Bus, SurvivesAHandlerThatThrows) {
  MemoryBus memory;
  memory.bus->publish(review("S-1"));
  memory.bus->publish(review("S-2"));
  EXPECT_THROW(memory.bus->receive(10, [](const Received&) { throw std::runtime_error("handler"); }),
               std::runtime_error);
  EXPECT_EQ(memory.receive_all().size(), 1u);
}

TEST(Bus, ChannelsAreNamesNotExpressions) {
  MemoryBus memory({}, {"R.VIEW"});
  memory.bus->publish(review("S-1"));
  EXPECT_TRUE(memory.receive_all().empty());
}

TEST(Bus, CorruptDatagramsNeverPass) {
  MemoryBus memory(parse_faults("seed=5,corrupt=0.5"));
  for (int i = 0; i < 1000; ++i) memory.bus->publish(review("S-" + std::to_string(i)));
  const auto all = memory.receive_all();
  EXPECT_GT(all.size(), 400u);
  EXPECT_LT(all.size(), 600u);
  EXPECT_EQ(static_cast<std::int64_t>(all.size()) + memory.bus->counters().rejected(), 1000);
}

TEST(Bus, NamesTheRemedyWhenItsAddressIsRefused) {
  BusOptions options;
  options.url = "nonsense://";
  EXPECT_FALSE(Bus::open(options));
}

TEST(Sequence, CountsGapsOfEachPublisherAndLateOnesAreNotLost) {
  SequenceCounter counter;
  const auto arrive = [&](const std::string& node, std::int64_t seq) { counter.count("C", {0, node, 1, seq, ""}); };
  arrive("a", 5);  // we began to listen late
  arrive("a", 6);
  arrive("b", 1);
  EXPECT_EQ(counter.lost(), 0);
  arrive("a", 9);
  EXPECT_EQ(counter.lost(), 2);
  arrive("a", 8);
  EXPECT_EQ(counter.lost(), 1);
}

TEST(Faults, AreReproducibleAndInTheAskedShares) {
  const FaultSettings settings = parse_faults("seed=7,drop=0.2,duplicate=0.05,reorder=0.05,corrupt=0.01");
  const auto play = [&] {
    FaultInjector injector(settings, "n");
    std::vector<std::string> arrived;
    for (int i = 0; i < 10'000; ++i) {
      for (const Datagram& datagram : injector.pass({"C", "message " + std::to_string(i)}))
        arrived.push_back(datagram.bytes);
    }
    return arrived;
  };
  const auto arrived = play();
  EXPECT_EQ(arrived, play());
  EXPECT_NEAR(static_cast<double>(arrived.size()), 10'000 * 0.8 * 1.05, 150);
}

TEST(Faults, UnreadableSettingsNameTheKey) {
  for (const char* text : {"drop=1.5", "drop", "drip=0.1", "seed=-1", "corrupt=nan"}) {
    EXPECT_THROW(parse_faults(text), InputError) << text;
  }
}

}  // namespace
}  // namespace nacre::runtime
