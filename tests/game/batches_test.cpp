// Batches for a cluster: how test requests are cut, when a task is taken for lost, what the files carry, what Slurm is
// told.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "base/random.hpp"
#include "simulator_farm/batch_file.hpp"
#include "simulator_farm/batch_plan.hpp"
#include "simulator_farm/slurm.hpp"

namespace nacre::simulator_farm {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Batches, HoldAboutAsMuchWorkAsIsAskedForAndEveryTestOnce) {
  EXPECT_THAT(cut_into_batches({1, 1, 1, 1, 1}, 2.0, 100), ElementsAre(2, 2, 1));
  EXPECT_THAT(cut_into_batches({5, 1, 1}, 2.0, 100), ElementsAre(1, 2)) << "a long test goes by itself";
  EXPECT_THAT(cut_into_batches({0, 0, 0}, 2.0, 2), ElementsAre(2, 1)) << "not too many tests";
  EXPECT_TRUE(cut_into_batches({}, 2.0, 2).empty());
}

TEST(Batches, CostsComeNearerToWhatTasksReport) {
  CostEstimate costs;
  const double guess = costs.seconds(tester::TestKind::toughness, tester::Fidelity::full);
  for (int i = 0; i < 100; ++i) costs.learn(tester::TestKind::toughness, tester::Fidelity::full, 10.0 * guess);
  EXPECT_NEAR(costs.seconds(tester::TestKind::toughness, tester::Fidelity::full), 10.0 * guess, 0.01 * guess);
  EXPECT_LT(costs.seconds(tester::TestKind::modulus, tester::Fidelity::full), guess) << "another kind of test";
}

constexpr Patience kPatience{.listing_s = 10.0, .sign_s = 100.0};

TEST(BatchWatch, ATaskThatWaitsIsNeverLost) {
  BatchWatch watch(0.0);
  watch.listed(TaskState::waiting, 1.0);
  EXPECT_FALSE(watch.is_lost(1e6, kPatience));
}

TEST(BatchWatch, AResultMayComeSomeTimeAfterSlurmHasForgottenTheTask) {
  BatchWatch watch(0.0);
  watch.listed(TaskState::running, 1.0);
  watch.listed(TaskState::absent, 20.0);
  watch.listed(TaskState::absent, 25.0);
  EXPECT_FALSE(watch.is_lost(29.0, kPatience));
  EXPECT_TRUE(watch.is_lost(30.0, kPatience));
}

TEST(BatchWatch, ARunningTaskIsLostWhenItGivesNoSignOfLife) {
  BatchWatch watch(0.0);
  watch.listed(TaskState::running, 1000.0);
  EXPECT_FALSE(watch.is_lost(1099.0, kPatience)) << "the time in the queue does not count";
  watch.sign("node-7 0 1", 1050.0);
  EXPECT_FALSE(watch.is_lost(1149.0, kPatience));
  watch.sign("node-7 0 1", 1149.0);
  EXPECT_TRUE(watch.is_lost(1150.0, kPatience)) << "the same sign is no new one";
}

TEST(BatchWatch, ATaskThatSlurmHoldsIsLostAndARequeuedOneIsNot) {
  BatchWatch held(0.0);
  held.listed(TaskState::held, 1.0);
  EXPECT_TRUE(held.is_lost(11.0, kPatience));
  BatchWatch requeued(0.0);
  requeued.listed(TaskState::running, 1.0);
  requeued.listed(TaskState::waiting, 50.0);
  EXPECT_FALSE(requeued.is_lost(1e6, kPatience));
}

TEST(Slurm, IsAskedLessAndLessOftenWhileItRefuses) {
  EXPECT_EQ(back_off_s(1), 1.0);
  EXPECT_EQ(back_off_s(4), 8.0);
  EXPECT_EQ(back_off_s(1000), 60.0);
}

TEST(Slurm, ListingsAreReadAndWhatIsNoTaskIsPassedOver) {
  const Listing tasks = read_listing(
      "nacre-1|0|RUNNING|None\nnacre-1|1|PENDING|Priority\nnacre-1|2|PENDING|launch failed requeued held\n"
      "nacre-1|N/A|RUNNING|None\nsqueue: warning\n\nnacre-1|3|COMPLETING|\n");
  EXPECT_EQ(tasks.size(), 4U);
  EXPECT_EQ(tasks.at({"nacre-1", 0}), TaskState::running);
  EXPECT_EQ(tasks.at({"nacre-1", 1}), TaskState::waiting);
  EXPECT_EQ(tasks.at({"nacre-1", 2}), TaskState::held);
  EXPECT_EQ(tasks.at({"nacre-1", 3}), TaskState::running);
}

TEST(Slurm, OptionsOfTheScenarioComeLastSoThatTheyWin) {
  const auto command =
      submission({.name = "n", .tasks = 3, .script = "/s/task.sh", .folder = "/s", .options = {"--cpus-per-task=2"}});
  EXPECT_EQ(command.back(), "/s/task.sh");
  EXPECT_EQ(command[command.size() - 2], "--cpus-per-task=2");
  EXPECT_THAT(command, testing::Contains("--array=0-2"));
}

std::vector<BatchRecord> records() {
  BatchRecord broken{
      .key = "k1", .response = {}, .breaks = std::vector<tester::Break>{{7, 0.01}, {9, 0.1}}, .seconds = 2};
  broken.response.toughness_pa = 1.0 / 3.0;
  broken.response.curve.strain = {0.0, 0.1};
  broken.response.curve.stress_pa = {1.0, 2.0 / 3.0};
  BatchRecord failed{.key = "k2", .response = {}, .breaks = std::nullopt, .seconds = 0.5};
  failed.response.failure = "J = 0";
  return {broken, failed};
}

TEST(BatchFiles, CarryEveryBit) {
  const Batch batch{"/run/films", {"spec one", std::string("\0two", 4)}};
  const auto read = read_batch(write_batch(batch));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->films, batch.films);
  EXPECT_EQ(read->specs, batch.specs);
  const auto answered = read_batch_result(write_batch_result("name", records()), "name");
  ASSERT_TRUE(answered) << answered.error().message;
  EXPECT_EQ(*answered, records());
}

TEST(BatchFiles, DamageAndForeignBatchesAreNoticed) {
  const std::string bytes = write_batch_result("name", records());
  EXPECT_THAT(read_batch_result(bytes, "another").error().message, HasSubstr("it is the result of batch name"));
  RandomStream random(3, "damage");
  for (int i = 0; i < 300; ++i) {
    std::string damaged = bytes;
    damaged[random.index(static_cast<int>(bytes.size()))] ^= static_cast<char>(1 << random.index(8));
    EXPECT_FALSE(read_batch_result(damaged, "name"));
    EXPECT_FALSE(read_batch_result(
        bytes.substr(0, static_cast<std::size_t>(random.index(static_cast<int>(bytes.size())))), "name"));
  }
}

}  // namespace
}  // namespace nacre::simulator_farm
