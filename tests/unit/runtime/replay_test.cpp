#include "runtime/replay.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/fold.hpp"
#include "runtime/journal.hpp"
#include "temporary_folder.hpp"
#include "wire/convert.hpp"
#include "wire/header.hpp"

namespace nacre::runtime {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Counts reviews and says after each how many there were; asks for work at every second one.
class CountingCore : public NodeCore {
 public:
  explicit CountingCore(int start = 0) : count_(start) {}
  Outputs step(const Input& input) override {
    Outputs outputs;
    if (const auto* message = std::get_if<Message>(&input); message && message->channel == "REVIEW") {
      ++count_;
      outputs.messages.push_back(approval(count_));
      if (count_ % 2 == 0)
        outputs.computes.push_back({"work/" + std::to_string(count_), "double", std::to_string(count_)});
    } else if (const auto* done = std::get_if<WorkDone>(&input)) {
      outputs.messages.push_back(approval(1000 + std::stoi(done->result)));
    }
    return outputs;
  }
  Status status() const override { return {}; }
  static Message approval(int round) {
    wire::Approval message;
    message.round = round;
    message.design = pattern::Mixture{0.0};
    return {"APPROVAL", wire::write(message)};
  }

 private:
  int count_ = 0;
};

const std::map<std::string, WorkFunction> kWork = {
    {"double", [](const std::string& spec) { return std::to_string(2 * std::stoi(spec)); }}};

/// Writes the journal of a node that receives `reviews` reviews, as the shell would.
class Recording {
 public:
  explicit Recording(const std::filesystem::path& folder) : journal_(Journal::open(folder, 1)) {}
  void review(int number) {
    wire::Review message;
    message.specimen = "S-" + std::to_string(number);
    const std::string payload = wire::write(message);
    add("REVIEW", wire::stamp_header("REVIEW", payload, {number, "person", 1, number, "run"}));
    step(Message{"REVIEW", payload});
  }
  void add(std::string_view channel, const std::string& data) { ASSERT_TRUE(journal_->append(1, channel, data)); }
  void step(const Input& input) {
    const Outputs outputs = core_.step(input);
    for (const Message& message : outputs.messages) add("~out/" + message.channel, message.payload);
    for (const Compute& compute : outputs.computes) {
      add(kComputeChannel, pack({compute.id, compute.kind, journaled_spec(compute)}));
      const WorkDone done{compute.id, kWork.at(compute.kind)(compute.spec)};
      add(kAckedChannel, pack({"some hash", "somebody", "1"}));
      add(kWorkChannel, pack({done.id, done.result}));
      step(done);
    }
  }

 private:
  std::unique_ptr<Journal> journal_;
  CountingCore core_;
};

TEST(Replay, IsNotDisturbedByIdentitiesOfTheJournal) {
  const TemporaryFolder folder;
  Recording recording(folder.path());
  recording.review(1);
  for (const std::vector<std::string>& identity : {std::vector<std::string>{"2"}, {"3", "another boot"}})
    recording.add(kJournalChannel, pack(identity));
  recording.review(2);
  CountingCore core;
  const ReplayReport report = replay_journal(folder.path() / "journal.lcm", core, kWork, true);
  EXPECT_TRUE(report.equal) << report.difference;
  EXPECT_EQ(report.inputs, 3);
}

TEST(Replay, ReproducesEveryOutputAndEveryResult) {
  const TemporaryFolder folder;
  Recording recording(folder.path());
  for (int i = 1; i <= 5; ++i) recording.review(i);
  CountingCore core;
  const ReplayReport report = replay_journal(folder.path() / "journal.lcm", core, kWork, true);
  EXPECT_TRUE(report.equal) << report.difference;
  EXPECT_EQ(report.inputs, 7);
  EXPECT_EQ(report.outputs, 7);
  EXPECT_EQ(report.computes, 2);
  EXPECT_EQ(report.recomputed, 2);
}

TEST(Replay, OfNothingIsNoAgreement) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "journal.lcm";
  std::ofstream(path).close();
  CountingCore core;
  EXPECT_THAT([&] { replay_journal(path, core); }, ThrowsMessage<InputError>(HasSubstr("nothing to replay")));
  EXPECT_THAT([&] { replay_bus_log(path, "proposal_agent", core, kWork); },
              ThrowsMessage<InputError>(HasSubstr("nothing to replay")));
}

TEST(Replay, NamesTheFirstFieldThatDiffers) {
  const TemporaryFolder folder;
  Recording recording(folder.path());
  for (int i = 1; i <= 3; ++i) recording.review(i);
  CountingCore other(10);
  const ReplayReport report = replay_journal(folder.path() / "journal.lcm", other);
  EXPECT_FALSE(report.equal);
  EXPECT_THAT(report.difference, HasSubstr("record 2 "));
  EXPECT_THAT(report.difference, HasSubstr("round: 1 against 11"));
}

TEST(Replay, FindsOutputsThatTheJournalHoldsTooManyOrTooFew) {
  const TemporaryFolder folder;
  Recording recording(folder.path());
  recording.review(1);
  recording.add("~out/APPROVAL", CountingCore::approval(5).payload);
  recording.review(2);
  CountingCore core;
  EXPECT_THAT(replay_journal(folder.path() / "journal.lcm", core).difference, HasSubstr("no longer sends"));

  const TemporaryFolder second;
  Recording short_one(second.path());
  wire::Review message;
  message.specimen = "S-1";
  const std::string payload = wire::write(message);
  for (int i = 0; i < 2; ++i) short_one.add("REVIEW", wire::stamp_header("REVIEW", payload, {i, "p", 1, i, "run"}));
  CountingCore again;
  EXPECT_THAT(replay_journal(second.path() / "journal.lcm", again).difference, HasSubstr("does not hold"));
}

TEST(Replay, AResultThatComesOutDifferentlyIsNamed) {
  const TemporaryFolder folder;
  Recording recording(folder.path());
  for (int i = 1; i <= 2; ++i) recording.review(i);
  CountingCore core;
  const std::map<std::string, WorkFunction> other = {{"double", [](const std::string&) { return std::string("5"); }}};
  EXPECT_TRUE(replay_journal(folder.path() / "journal.lcm", core).equal);
  CountingCore again;
  const ReplayReport report = replay_journal(folder.path() / "journal.lcm", again, other, true);
  EXPECT_FALSE(report.equal);
  EXPECT_THAT(report.difference, HasSubstr("work/2"));
}

TEST(Replay, AFlippedBitInAnInputIsDamageNotADecision) {
  const TemporaryFolder folder;
  {
    Recording recording(folder.path());
    recording.review(1);
    std::string bytes = wire::stamp_header("REVIEW", CountingCore::approval(1).payload, {1, "p", 1, 1, "run"});
    bytes.back() = static_cast<char>(bytes.back() ^ 1);
    recording.add("REVIEW", bytes);
  }
  CountingCore core;
  EXPECT_THAT(replay_journal(folder.path() / "journal.lcm", core).difference, HasSubstr("checksum"));
}

TEST(Fold, HandsOverWhatTheLastInputCausedAndTheJournalLacks) {
  const TemporaryFolder folder;
  auto journal = Journal::open(folder.path(), 1);
  wire::Review message;
  message.specimen = "S-1";
  ASSERT_TRUE(journal->append(1, "REVIEW", wire::stamp_header("REVIEW", wire::write(message), {1, "p", 1, 1, "run"})));
  journal.reset();
  CountingCore core;
  Fold fold(core);
  LogReader reader(folder.path() / "journal.lcm");
  while (const auto record = reader.next()) ASSERT_TRUE(fold.feed(*record));
  const Outputs unfinished = fold.take_unfinished();
  ASSERT_EQ(unfinished.messages.size(), 1u);
  EXPECT_EQ(unfinished.messages[0], CountingCore::approval(1));
  EXPECT_TRUE(fold.open_work().empty());
}

TEST(Replay, OfABusLogComparesWhatWasSaid) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "run.lcm";
  {
    LogWriter writer(path);
    const auto log = [&](const std::string& node, const Message& message) {
      ASSERT_TRUE(writer.append(1, message.channel,
                                wire::stamp_header(message.channel, message.payload, {1, node, 1, 1, "run"})));
    };
    wire::Review review;
    review.specimen = "S-1";
    for (int repeat = 0; repeat < 2; ++repeat) log("person", {"REVIEW", wire::write(review)});
    log("analyser", CountingCore::approval(1));
  }
  CountingCore core;
  const ReplayReport report = replay_bus_log(path, "analyser", core, kWork);
  EXPECT_TRUE(report.equal) << report.difference;
  EXPECT_EQ(report.inputs, 1);  // a repetition is no input
  EXPECT_THAT(report.note, HasSubstr("best effort"));
  CountingCore other(3);
  EXPECT_FALSE(replay_bus_log(path, "analyser", other, kWork).equal);
}

TEST(Replay, OfABusLogWithMessagesOfAnotherVersionIsNoAgreement) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "run.lcm";
  {
    LogWriter writer(path);
    std::string message = wire::stamp_header("REVIEW", wire::write(wire::Review{}), {1, "person", 1, 1, "run"});
    message[0] = static_cast<char>(message[0] ^ 1);
    ASSERT_TRUE(writer.append(1, "REVIEW", message));
  }
  CountingCore core;
  const ReplayReport report = replay_bus_log(path, "analyser", core, kWork);
  EXPECT_FALSE(report.equal);
  EXPECT_THAT(report.difference,
              HasSubstr("of another version of nacre (manifest.json names it), which cannot be read: 1"));
}

}  // namespace
}  // namespace nacre::runtime
