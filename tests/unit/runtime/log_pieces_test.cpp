// Logs in pieces: read together they are one log, and each shows by itself how the game stands.

#include "runtime/log_pieces.hpp"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/journal.hpp"
#include "runtime/latest_state.hpp"
#include "temporary_folder.hpp"
#include "wire/convert.hpp"
#include "wire/header.hpp"

namespace nacre::runtime {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

class LogInPieces : public testing::Test {
 protected:
  /// A piece of records "a", "b", ...; a later one with `repeated` before them.
  void write(int number, const std::vector<std::string>& channels, const std::vector<std::string>& repeated = {}) {
    LogWriter writer(piece_of(log_, number));
    if (number > 1) {
      ASSERT_TRUE(writer.append(1, kPieceChannel, pack({std::to_string(number), std::to_string(repeated.size())})));
    }
    for (const auto* list : {&repeated, &channels})
      for (const std::string& channel : *list) ASSERT_TRUE(writer.append(1, channel, "bytes"));
  }
  static std::vector<std::string> read(PiecesReader& reader) {
    std::vector<std::string> channels;
    while (const auto record = reader.next()) channels.push_back(record->channel);
    return channels;
  }
  TemporaryFolder folder_;
  fs::path log_ = folder_.path() / "run.lcm";
};

TEST_F(LogInPieces, IsReadAsOneThatRepeatsNothing) {
  write(1, {"a", "b"});
  write(2, {"c"}, {"a", "b"});
  write(3, {"d", "e"}, {"b", "c"});
  std::ofstream(folder_.path() / "run-4.lcm.part") << "unfinished";
  std::ofstream(folder_.path() / "run-x.lcm") << "another file";
  PiecesReader reader(log_);
  EXPECT_THAT(read(reader), ElementsAre("a", "b", "c", "d", "e"));
  EXPECT_EQ(reader.path(), piece_of(log_, 3));
}

TEST_F(LogInPieces, OfALaterPieceByNameThatAloneIsRead) {
  write(1, {"a"});
  write(2, {"b"}, {"a"});
  write(3, {"c"}, {"b"});
  PiecesReader reader(piece_of(log_, 2));
  EXPECT_THAT(read(reader), ElementsAre(kPieceChannel, "a", "b"));
}

TEST_F(LogInPieces, WithoutOneInTheMiddleIsRefused) {
  write(1, {"a"});
  write(3, {"c"});
  EXPECT_THAT([&] { PiecesReader reader(log_); },
              ThrowsMessage<InputError>(HasSubstr("run-2.lcm: is missing, a piece of a log that goes on in ")));
}

TEST_F(LogInPieces, BehindAMarkThatIsGarbledNothingIsTakenForRepeated) {
  write(1, {"a"});
  LogWriter later(piece_of(log_, 2));
  ASSERT_TRUE(later.append(1, kPieceChannel, pack({"2", "no number"})));
  ASSERT_TRUE(later.append(1, "b", "bytes"));
  ASSERT_TRUE(later.flush());
  PiecesReader reader(log_);
  EXPECT_THAT(read(reader), ElementsAre("a", "b"));
}

TEST_F(LogInPieces, TornAndDamagedPiecesGiveTheRest) {
  write(1, {"a", "b"});
  write(2, {"c", "d"}, {"a"});
  fs::resize_file(log_, fs::file_size(log_) - 1);
  std::fstream file(piece_of(log_, 2), std::ios::in | std::ios::out);
  file.seekp(kRecordHeaderSize + 6 + 2 * 4 + 2 + 32);  // behind the mark
  file << "damage";
  file.close();
  PiecesReader reader(log_);
  EXPECT_EQ(reader.next()->channel, "a");
  EXPECT_THROW(reader.next(), InputError);
  reader.resync();
  EXPECT_THAT(read(reader), ElementsAre("c", "d")) << "what the damaged record repeated is not taken for news";
  EXPECT_GT(reader.end().torn_bytes, 0);
}

class State : public testing::Test {
 protected:
  template <class Message>
  void say(const std::string& channel, const Message& message, const std::string& node = "node") {
    state_.take(channel, wire::stamp_header(channel, wire::write(message), {++said_, node, 1, said_, "run"}));
  }
  std::vector<std::string> channels() const {
    std::vector<std::string> channels;
    for (const LatestState::Kept& each : state_.messages())
      channels.push_back(each.channel + " " + std::to_string(each.round));
    return channels;
  }
  static wire::GamutChunk gamut(int round, int base) {
    return {.round = round, .base = base, .total = 0, .samples = {}};
  }
  LatestState state_;
  std::int64_t said_ = 0;
};

TEST_F(State, IsTheLatestOfEachKindAndTheWholeGamut) {
  for (int round = 0; round < 4; ++round) {
    wire::Proposal proposal;
    proposal.round = round;
    say("PROPOSAL", proposal);
    say("GAMUT", gamut(round, round < 2 ? -1 : round - 1));
  }
  EXPECT_THAT(channels(), ElementsAre("GAMUT 1", "GAMUT 2", "PROPOSAL 3", "GAMUT 3"));
  say("GAMUT", gamut(1, -1));  // said again
  EXPECT_THAT(channels(), ElementsAre("GAMUT 2", "PROPOSAL 3", "GAMUT 3", "GAMUT 1"));
}

TEST_F(State, AnOlderRoundReplacesNothing) {
  wire::Proposal proposal;
  for (proposal.round = 2; proposal.round > 0; --proposal.round) say("PROPOSAL", proposal);
  EXPECT_THAT(channels(), ElementsAre("PROPOSAL 2"));
}

TEST_F(State, OrdersStandUntilTheirRoundIsClosed) {
  wire::TestOrder order;
  order.round = 1;
  for (const char* id : {"a", "b"}) {
    order.order_id = id;
    say("TEST_ORDER", order);
  }
  EXPECT_THAT(channels(), ElementsAre("TEST_ORDER 1", "TEST_ORDER 1"));
  wire::RoundSummary round;
  round.round = 1;
  say("ROUND", round);
  EXPECT_THAT(channels(), ElementsAre("ROUND 1"));
}

TEST_F(State, HoldsAStatusOfEachNodeAndNoMeasurements) {
  for (const char* node : {"analyser", "virtual_lab", "analyser"}) say("STATUS", wire::NodeStatus{}, node);
  say("MEASUREMENT", wire::Measurement{});
  state_.take("NOISE", "noise");
  state_.take("ROUND", "noise");
  EXPECT_THAT(channels(), ElementsAre("STATUS 0", "STATUS 0"));
}

}  // namespace
}  // namespace nacre::runtime
