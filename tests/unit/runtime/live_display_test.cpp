#include "runtime/live_display.hpp"

#include <cstdio>
#include <cstdlib>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/recent_problem.hpp"
#include "runtime/restart_budget.hpp"
#include "runtime/terminal.hpp"

namespace nacre::runtime {
namespace {

using std::chrono::seconds;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

NodeView busy_node() {
  return {.node = "validation_agent",
          .state = "running",
          .phase = "calibrating",
          .round = 2,
          .progress = 0.5,
          .eta_s = 83.0,
          .restarts = 1,
          .problem = "a datagram was damaged"};
}

/// What a display writes into memory.
class Screen {
 public:
  std::FILE* stream() { return stream_; }
  std::string taken() {
    std::fflush(stream_);
    std::string text(buffer_, size_);
    std::rewind(stream_);
    return text;
  }
  ~Screen() {
    std::fclose(stream_);
    std::free(buffer_);
  }

 private:
  char* buffer_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* stream_ = open_memstream(&buffer_, &size_);
};

TEST(Terminal, BarFillsWithProgressAndStaysEmptyWhenItIsUnknown) {
  EXPECT_EQ(bar(0.0, 4), "[....]");
  EXPECT_EQ(bar(0.5, 4), "[##..]");
  EXPECT_EQ(bar(1.0, 4), "[####]");
  EXPECT_EQ(bar(7.0, 4), "[####]");
  EXPECT_EQ(bar(-1.0, 4), "[....]");
  EXPECT_EQ(bar(std::nan(""), 4), "[....]");
}

TEST(Terminal, TimesAreSaidInTheUnitsOfTheirSize) {
  EXPECT_EQ(in_words(7.2), "8 s");
  EXPECT_EQ(in_words(125.0), "2 min 5 s");
  EXPECT_EQ(in_words(3.0 * 3600 + 12 * 60), "3 h 12 min");
  EXPECT_EQ(in_words(-1.0), "");
  EXPECT_EQ(in_words(std::nan("")), "");
}

TEST(Terminal, TimeLeftIsSaidRoughly) {
  EXPECT_EQ(time_left_in_words(7.2), "less than a minute left");
  EXPECT_EQ(time_left_in_words(200.0), "about 4 min left");
  EXPECT_EQ(time_left_in_words(3.0 * 3600 + 12 * 60), "about 3 h left");
  EXPECT_EQ(time_left_in_words(-1.0), "");
  EXPECT_EQ(time_left_in_words(std::nan("")), "");
}

TEST(Terminal, LinesAreCutBetweenCharactersAndCarryNoControlCodes) {
  EXPECT_EQ(fitted("abcdef", 3), "abc");
  EXPECT_EQ(fitted("\xC3\xA4\xC3\xB6\xC3\xBC", 2), "\xC3\xA4\xC3\xB6");
  EXPECT_EQ(fitted("a\x1b[2Jb\n", 20), "a [2Jb ");
}

TEST(LiveDisplay, LineOfANodeSaysRoundProgressTimeLeftAndProblem) {
  const std::string line = node_line(busy_node(), 200);
  EXPECT_THAT(line, AllOf(HasSubstr("validation_agent"), HasSubstr("round 2"), HasSubstr("[########........]"),
                          HasSubstr("50 %"), HasSubstr("calibrating"), HasSubstr("1 min 23 s left"),
                          HasSubstr("damaged"), HasSubstr("restarted 1 x")));
  EXPECT_LE(node_line(busy_node(), 60).size(), 60U);
}

NodeView node(const std::string& name, const std::string& phase, int round = 1) {
  NodeView view;
  view.node = name;
  view.state = "running";
  view.phase = phase;
  view.round = round;
  return view;
}

TEST(LiveDisplay, WhatIsCompleteShowsNoShare) {
  NodeView waiting = node("validation_agent", "waits for you: 1 design to approve", 2);
  waiting.progress = 1.0;
  EXPECT_EQ(plain_node_line(waiting), "validation_agent: round 2, waits for you: 1 design to approve");
  EXPECT_THAT(node_line(waiting, 200), AllOf(Not(HasSubstr("%")), Not(HasSubstr("#"))));
  waiting.progress = 0.25;
  EXPECT_EQ(plain_node_line(waiting), "validation_agent: round 2, waits for you: 1 design to approve, 25 %");
}

TEST(LiveDisplay, LineOfTheGameSaysRoundStepAndTimeLeft) {
  std::vector<NodeView> views = {node("simulator_farm", "simulating, 3 of 40 tests done"), node("analyser", "idle"),
                                 node("proposal_agent", "searching"),
                                 node("validation_agent", "waiting for the search and its proposal")};
  views[2].eta_s = 200.0;
  EXPECT_EQ(game_line(views, 3), "round 1 of 3, searching, about 4 min left");
  views[2] = node("proposal_agent", "waiting for a model");
  views[3].phase = "waiting for the diagnosis";
  views[1].phase = "diagnosing";
  EXPECT_EQ(game_line(views, 3), "round 1 of 3, diagnosing");
  views[3].phase = "measuring, 2 of 6 orders complete";
  EXPECT_EQ(game_line(views, 3), "round 1 of 3, measuring, 2 of 6 orders complete");
}

TEST(LiveDisplay, LineOfTheGameCountsFromRoundOne) {
  EXPECT_EQ(game_line({node("validation_agent", "calibrating", 0)}, 3), "preparing round 1 of 3, calibrating");
  EXPECT_EQ(game_line({node("validation_agent", "measuring, 0 of 4 orders complete", 4)}, 3),
            "after the last round, measuring, 0 of 4 orders complete");
}

TEST(LiveDisplay, WhatIsLeftOfRoundAndGameIsToldByTheLastWholeRound) {
  const RoundClock::Clock::time_point start{};
  RoundClock clock;
  clock.see(0, start);
  clock.see(1, start + seconds(200));
  EXPECT_EQ(time_left_of_game(clock, 3, start + seconds(300)), "") << "round 0 is of another kind";
  clock.see(2, start + seconds(800));
  EXPECT_EQ(time_left_of_game(clock, 3, start + seconds(920)), "; about 8 min of the round, about 18 min of the game");
  EXPECT_EQ(time_left_of_game(clock, 3, start + seconds(1500)), "") << "longer than the one before";
  clock.see(3, start + seconds(1600));
  EXPECT_EQ(time_left_of_game(clock, 3, start + seconds(1660)), "; about 13 min of the round, about 13 min of the game")
      << "800 s";
}

// Whoever resumes a game has not seen its round begin.
TEST(LiveDisplay, ARoundThatWasJoinedLateTellsNothing) {
  const RoundClock::Clock::time_point start{};
  RoundClock clock;
  clock.see(2, start);
  clock.see(3, start + seconds(30));
  EXPECT_EQ(time_left_of_game(clock, 5, start + seconds(40)), "");
  clock.see(4, start + seconds(630));
  EXPECT_EQ(time_left_of_game(clock, 5, start + seconds(630)), "; about 10 min of the round, about 20 min of the game");
}

TEST(LiveDisplay, LineOfTheGameIsThereOnceTheValidationAgentHasReported) {
  NodeView silent;
  silent.node = "validation_agent";
  EXPECT_EQ(game_line({silent, node("proposal_agent", "searching")}, 3), "");
  silent.round = 2;
  silent.state = "restarting";
  EXPECT_EQ(game_line({silent, node("proposal_agent", "waiting for a model")}, 3), "round 2 of 3, restarting");
}

TEST(LiveDisplay, TerminalIsRefreshedInPlaceAndOnlyWhenSomethingChanged) {
  Screen screen;
  LiveDisplay display(screen.stream(), 100, 3);
  display.show({busy_node()}, {});
  const std::string once = screen.taken();
  display.show({busy_node()}, {});
  EXPECT_EQ(screen.taken(), "") << "nothing changed";
  NodeView later = busy_node();
  later.progress = 0.75;
  display.show({later}, {});
  EXPECT_THAT(screen.taken(), AllOf(HasSubstr("\x1b[2A"), HasSubstr("75 %")));
  EXPECT_THAT(once, Not(HasSubstr("\x1b")));
}

TEST(LiveDisplay, FilesGetANodesLineAtMostEveryTenSeconds) {
  Screen screen;
  LiveDisplay display(screen.stream(), 0, 3);
  const LiveDisplay::Clock::time_point start{};
  NodeView view = busy_node();
  display.show({view}, start);
  EXPECT_THAT(screen.taken(), HasSubstr("50 %"));
  view.progress = 0.6;
  display.show({view}, start + seconds(9));
  EXPECT_EQ(screen.taken(), "");
  display.show({view}, start + seconds(10));
  EXPECT_THAT(screen.taken(), AllOf(HasSubstr("60 %"), Not(HasSubstr("\x1b"))));
  display.show({view}, start + seconds(60));
  EXPECT_EQ(screen.taken(), "") << "nothing changed";
}

TEST(RecentProblem, IsShownForAMinuteAndANewOneForAnother) {
  constexpr std::int64_t kSecondUs = 1'000'000;
  RecentProblem problem;
  EXPECT_EQ(problem.shown(0), "");
  problem.note("a junk datagram", 5 * kSecondUs);
  EXPECT_EQ(problem.shown(64 * kSecondUs), "a junk datagram");
  EXPECT_EQ(problem.shown(65 * kSecondUs), "");
  problem.note("another one", 70 * kSecondUs);
  EXPECT_EQ(problem.shown(120 * kSecondUs), "another one");
}

TEST(RestartBudget, WaitsTwiceAsLongEachTime) {
  RestartBudget budget({.most = 5, .first_wait = seconds(1), .longest_wait = seconds(6), .settled_after = seconds(60)});
  RestartBudget::Clock::time_point now{};
  for (const int wait_s : {1, 2, 4, 6, 6}) {
    const auto wait = budget.take(now);
    ASSERT_TRUE(wait);
    EXPECT_EQ(*wait, seconds(wait_s));
    now += *wait;
  }
  EXPECT_FALSE(budget.take(now));
}

TEST(RestartBudget, OutlastsADiskThatIsFullForAMinuteAndGivesUpWithinThree) {
  RestartBudget budget({});
  const RestartBudget::Clock::time_point first_death{};
  RestartBudget::Clock::time_point now = first_death;
  while (const auto wait = budget.take(now)) now += *wait;
  EXPECT_GT(now - first_death, seconds(75));
  EXPECT_LT(now - first_death, seconds(180));
}

TEST(RestartBudget, ANodeThatHasLivedForAWhileHasANewOne) {
  RestartBudget budget(
      {.most = 2, .first_wait = seconds(1), .longest_wait = seconds(30), .settled_after = seconds(60)});
  RestartBudget::Clock::time_point now{};
  for (int death = 0; death < 10; ++death, now += seconds(61)) EXPECT_EQ(budget.take(now), seconds(1)) << death;
  now -= seconds(30);  // it lived half as long
  EXPECT_EQ(budget.take(now), seconds(2));
  EXPECT_FALSE(budget.take(now + seconds(2)));
}

TEST(LiveDisplay, AReaderWhoHasGoneOrAFullDiskDoesNotEndIt) {
  std::FILE* const full = std::fopen("/dev/full", "w");
  ASSERT_NE(full, nullptr);
  std::setvbuf(full, nullptr, _IONBF, 0);
  for (const int columns : {0, 80}) {
    LiveDisplay display(full, columns, 3);
    EXPECT_NO_THROW({
      display.show({busy_node()}, {});
      display.say("a line");
    });
  }
  std::fclose(full);
}

}  // namespace
}  // namespace nacre::runtime
