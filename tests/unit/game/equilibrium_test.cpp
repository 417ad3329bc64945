#include "game/equilibrium.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace nacre::game {
namespace {

using testing::HasSubstr;

TEST(Equilibrium, NeedsTwoQuietRoundsRunning) {
  std::vector<RoundFigures> history = {{0, 0.0, 0.0, 2.0}, {1, 0.70, 0.03, 0.50}, {2, 0.71, 0.03, 0.05}};
  EXPECT_FALSE(judge_equilibrium(history).equilibrium) << "round 1 is the first with measurements";
  history.push_back({3, 0.72, 0.03, 0.04});
  EXPECT_TRUE(judge_equilibrium(history).equilibrium);
}

TEST(Equilibrium, HypervolumeGrowthBeyondItsErrorGoesOn) {
  const std::vector<RoundFigures> history = {
      {0, 0, 0, 2}, {1, 0.70, 0.03, 0.5}, {2, 0.71, 0.03, 0.05}, {3, 0.745, 0.03, 0.05}};
  const EquilibriumCheck check = judge_equilibrium(history);
  EXPECT_FALSE(check.equilibrium);
  EXPECT_THAT(check.decided_by, HasSubstr("grew by 0.035"));
}

TEST(Equilibrium, AnOpenMovingGapGoesOn) {
  const std::vector<RoundFigures> history = {
      {0, 0, 0, 2}, {1, 0.70, 0.03, 0.5}, {2, 0.71, 0.03, 0.40}, {3, 0.71, 0.03, 0.30}};
  const EquilibriumCheck check = judge_equilibrium(history);
  EXPECT_FALSE(check.equilibrium);
  EXPECT_THAT(check.decided_by, HasSubstr("exceeds twice the standard error"));
}

TEST(Equilibrium, AWideGapThatNoLongerMovesEndsTheGame) {
  const std::vector<RoundFigures> history = {
      {0, 0, 0, 2}, {1, 0.70, 0.03, 0.50}, {2, 0.71, 0.03, 0.48}, {3, 0.71, 0.03, 0.47}};
  const EquilibriumCheck check = judge_equilibrium(history);
  EXPECT_TRUE(check.equilibrium);
  EXPECT_THAT(check.decided_by, HasSubstr("less than 10 %"));
}

TEST(Equilibrium, ANegativeGapIsJudgedByItsSize) {
  const std::vector<RoundFigures> history = {
      {0, 0, 0, 2}, {1, 0.70, 0.03, -0.5}, {2, 0.70, 0.03, -0.05}, {3, 0.70, 0.03, -0.055}};
  EXPECT_TRUE(judge_equilibrium(history).equilibrium);
  const std::vector<RoundFigures> open = {
      {0, 0, 0, 2}, {1, 0.70, 0.03, -0.5}, {2, 0.70, 0.03, -0.05}, {3, 0.70, 0.03, -0.3}};
  EXPECT_FALSE(judge_equilibrium(open).equilibrium);
}

TEST(Equilibrium, WithoutReplicatesAStandstillCounts) {
  const std::vector<RoundFigures> history = {
      {0, 0, 0, 2}, {1, 0.7, 0.0, 0.50}, {2, 0.7, 0.0, 0.49}, {3, 0.7, 0.0, 0.48}};
  EXPECT_TRUE(judge_equilibrium(history).equilibrium);
}

TEST(Equilibrium, TheSentenceNamesTheDecidingNumber) {
  EXPECT_THAT(judge_equilibrium({}).decided_by, HasSubstr("nothing has been measured"));
  const std::vector<RoundFigures> history = {
      {0, 0, 0, 2}, {1, 0.70, 0.03, 0.5}, {2, 0.71, 0.03, 0.05}, {3, 0.72, 0.03, 0.01}};
  EXPECT_THAT(judge_equilibrium(history).decided_by, HasSubstr("within twice the standard error of 0.03"));
}

}  // namespace
}  // namespace nacre::game
