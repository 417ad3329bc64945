// The family stage after the last round: its course, its determinism, its restart, a person's grouping and approval.

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../instrumented.hpp"
#include "base/files.hpp"
#include "base/statistics.hpp"
#include "families/dense_sampling.hpp"
#include "families/families_file.hpp"
#include "families/grouping.hpp"
#include "game/standings.hpp"
#include "in_process_game.hpp"
#include "pattern/constraints.hpp"
#include "stand_ins.hpp"
#include "validation_agent/family_work.hpp"
#include "validation_agent/order_desk.hpp"
#include "validation_agent/validation_core.hpp"

namespace nacre::game_test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

game::Scenario with_families() {
  game::Scenario scenario = small_scenario();
  scenario.rounds = 1;
  scenario.families.enabled = true;
  scenario.families.samples = 40;
  scenario.families.designs = 2;
  scenario.families.calibration_evaluations = 6;
  scenario.families.modulus_evaluations = 12;
  return scenario;
}

InProcessGame played(const game::Scenario& scenario, const Delivery& delivery = {}) {
  InProcessGame game(delivery);
  add_players(game, scenario);
  game.announce(scenario);
  game.play();
  return game;
}

/// The second word of each family, by number.
std::vector<wire::CalibratedFamily> validated(const InProcessGame& game) {
  std::vector<wire::CalibratedFamily> families = game.sent<wire::CalibratedFamily>("FAMILY");
  std::erase_if(families, [](const wire::CalibratedFamily& family) { return !family.is_validated; });
  return families;
}

TEST(FamilyStage, FollowsTheLastRoundAndClosesItForGood) {
  const game::Scenario scenario = with_families();
  InProcessGame game = played(scenario);
  const auto rounds = game.sent<wire::RoundSummary>("ROUND");
  ASSERT_THAT(rounds, SizeIs(3));
  EXPECT_EQ(rounds[1].round, 1);
  EXPECT_FALSE(rounds[1].last);
  EXPECT_THAT(rounds[1].decided_by, HasSubstr("families follow"));
  wire::RoundSummary again = rounds[1];
  again.last = true;
  again.decided_by = rounds[2].decided_by;
  EXPECT_EQ(rounds[2], again) << "the same figures, sent as the last";
  const auto families = validated(game);
  ASSERT_FALSE(families.empty());
  EXPECT_EQ(game.sent<wire::CalibratedFamily>("FAMILY").size(), 2 * families.size());
  for (const char* node : {"validation_agent", "proposal_agent", "simulator_farm"})
    EXPECT_TRUE(game.status_of(node).finished) << node;
}

TEST(FamilyStage, ChosenDesignsAreFeasibleVariantsMeasuredAndPredictedByBothModels) {
  InProcessGame game = played(with_families());
  for (const wire::CalibratedFamily& family : validated(game)) {
    std::vector<pattern::Pattern> seeds;
    int chosen = 0;
    for (const game::FamilyDesign& design : family.designs) {
      if (design.is_seed) {
        seeds.push_back(design.pattern);
      } else {
        ++chosen;
        EXPECT_TRUE(pattern::is_feasible(design.pattern));
        EXPECT_LE(families::nearest_seed(design.pattern, seeds).difference, 16);
      }
      EXPECT_TRUE(design.measured.modulus_pa && design.measured.toughness_pa) << design.pattern.key();
      EXPECT_TRUE(design.global_model.modulus_pa && design.family_model.toughness_pa);
    }
    EXPECT_FALSE(seeds.empty());
    EXPECT_EQ(chosen, 2) << family.name;
    EXPECT_EQ(family.samples, 40);
  }
}

/// A laboratory that also pulls a twin of every specimen ten times as slowly, and reports it first.
class CuriousLaboratory : public runtime::NodeCore {
 public:
  runtime::Outputs step(const runtime::Input& input) override {
    runtime::Outputs outputs = twins_->step(input);
    for (runtime::Message& message : usual_->step(input).messages) outputs.messages.push_back(std::move(message));
    return outputs;
  }
  runtime::Status status() const override { return {}; }

 private:
  static void pull_slowly(wire::Measurement& measured) {
    measured.order_id.clear();
    measured.record.specimen += "-slow";
    measured.record.conditions.strain_rate_per_s *= 0.1;
    for (auto* value : {&measured.record.modulus_pa, &measured.record.toughness_pa})
      if (*value) **value *= 0.5;
  }
  std::unique_ptr<runtime::NodeCore> usual_ = make_laboratory();
  std::unique_ptr<runtime::NodeCore> twins_ = make_laboratory({.hidden = {}, .spoil = pull_slowly});
};

TEST(FamilyStage, WhatWasMeasuredOfADesignIsNotWhatItsTwinAtAnotherRateShowed) {
  const game::Scenario scenario = with_families();
  InProcessGame game;
  add_players(game, scenario);
  game.add("virtual_lab", std::make_unique<CuriousLaboratory>());
  game.announce(scenario);
  game.play();
  std::vector<measurement::SpecimenRecord> specimens;
  for (const auto& measured : game.sent<wire::Measurement>("MEASUREMENT")) specimens.push_back(measured.record);
  const auto values = game::measured_values(specimens);
  ASSERT_FALSE(validated(game).empty());
  for (const wire::CalibratedFamily& family : validated(game)) {
    for (const game::FamilyDesign& design : family.designs) {
      const std::string name = design.pattern.key() + (design.is_seed ? ", a seed" : ", chosen");
      ASSERT_TRUE(design.measured.modulus_pa && design.measured.toughness_pa) << name;
      const game::MeasuredValues& own = values.at(design.pattern);
      EXPECT_NEAR(*design.measured.modulus_pa / mean(own.modulus_pa), 1.0, 1e-9) << name;
      EXPECT_NEAR(*design.measured.toughness_pa / mean(own.toughness_pa), 1.0, 1e-9) << name;
    }
  }
}

TEST(FamilyStage, ItsModelIsNearerToItsSeedsThanTheGlobalOne) {
  InProcessGame game = played(with_families());
  double global = 0.0, own = 0.0;
  for (const wire::CalibratedFamily& family : validated(game)) {
    const game::FamilyErrors errors = game::family_errors(family.designs);
    global += errors.seeds_global.toughness_mean;
    own += errors.seeds_family.toughness_mean;
  }
  EXPECT_LT(own, global);
}

TEST(FamilyStage, LateShuffledAndRepeatedDeliveryIsTheSameStage) {
  const game::Scenario scenario = with_families();
  const auto essence = played(scenario).essence();
  EXPECT_EQ(played(scenario, {.seed = 5, .repeat_probability = 0.2}).essence(), essence);
}

TEST(FamilyStage, AFreshCoreRepeatsItsJournalWordForWord) {
  const game::Scenario scenario = with_families();
  InProcessGame game = played(scenario);
  EXPECT_GT(game.replay("validation_agent", *validation_agent::make_core(scenario)), 50U);
}

TEST(FamilyStage, NoStepTakesLongerThanATenthOfASecond) {
  game::Scenario scenario = with_families();
  scenario.families.samples = 400;
  EXPECT_LT(played(scenario).longest_step_s(), 0.1 * test::kPatience);
}

TEST(FamilyStage, IsPlayedOnRequestAlone) {
  game::Scenario scenario = with_families();
  scenario.families.enabled = false;
  InProcessGame game = played(scenario);
  EXPECT_THAT(game.payloads("FAMILY"), IsEmpty());
  EXPECT_THAT(game.work_of("validation_agent"), IsEmpty());
  EXPECT_TRUE(game.sent<wire::RoundSummary>("ROUND").back().last);
}

TEST(FamilyStage, MeasuresWhatAPersonAddedAfterTheLastRoundWasMeasured) {
  validation_agent::OrderDesk desk(with_families());
  (void)desk.open_round(1, {}, {});
  const pattern::Design own = pattern::Pattern(0x577fffe9fffdef), chosen = pattern::Pattern(0x3ffc9b4ad4d2d9);
  for (const pattern::Design& design : {own, chosen}) EXPECT_THAT(desk.add_own(design, false).value(), IsEmpty());
  const std::vector<game::Order> orders = desk.open_family_round(2, {chosen});
  ASSERT_THAT(orders, SizeIs(4)) << "both tests of each; what is chosen is not ordered twice";
  for (const game::Order& order : orders) {
    EXPECT_EQ(order.round, 2);
    EXPECT_EQ(order.reason, order.design == own ? game::OrderReason::person : game::OrderReason::family);
  }
  EXPECT_THAT(desk.own(), IsEmpty());
}

TEST(FamilyStage, WaitsForAPersonsYesWhereTheScenarioSaysSo) {
  game::Scenario scenario = with_families();
  scenario.rounds = 1;
  scenario.validation.approval = true;
  InProcessGame game;
  add_players(game, scenario);
  game.announce(scenario);
  game.play();
  const auto send_approval = [&](int round, const pattern::Design& design, bool yes) {
    wire::Approval approval;
    approval.round = round;
    approval.design = design;
    approval.approved = yes;
    approval.by = "a person";
    game.publish({"APPROVAL", wire::write(approval)});
  };
  const wire::Proposal first = game.sent<wire::Proposal>("PROPOSAL").at(0);
  for (const auto& proposed : first.designs) send_approval(0, proposed.design, true);
  game.play();
  EXPECT_THAT(validated(game), IsEmpty()) << "nobody has approved the variants yet";
  std::vector<pattern::Pattern> chosen;
  for (const wire::CalibratedFamily& family : game.sent<wire::CalibratedFamily>("FAMILY")) {
    for (const game::FamilyDesign& design : family.designs)
      if (!design.is_seed) chosen.push_back(design.pattern);
  }
  ASSERT_FALSE(chosen.empty());
  for (const pattern::Pattern& each : chosen) send_approval(2, each, each != chosen.front());
  game.play();
  ASSERT_FALSE(validated(game).empty());
  for (const wire::CalibratedFamily& family : validated(game)) {
    for (const game::FamilyDesign& design : family.designs)
      EXPECT_EQ(design.measured.toughness_pa.has_value(), design.pattern != chosen.front());
  }
}

std::vector<families::MeasuredPattern> three_measured() {
  return {{pattern::Pattern(0x577fffe9fffdef), {1.5e9, 4e5}},
          {pattern::Pattern(0x3ffc9b4ad4d2d9), {1.1e9, 5e5}},
          {pattern::Pattern((std::uint64_t{1} << 55) - 1), {2.6e9, 1e5}}};
}

TEST(FamilyGrouping, APersonsFileIsTakenAndAFaultyOnePassedOver) {
  const std::filesystem::path run = std::filesystem::path(testing::TempDir()) / "family_grouping";
  std::filesystem::remove_all(run);
  const std::filesystem::path file = run / "families" / "families.toml";
  const auto group = validation_agent::work_functions(run).at("group_families");
  const std::string spec = validation_agent::grouping_spec(three_measured(), 2);
  const auto proposed = validation_agent::grouping_from(group(spec));
  EXPECT_EQ(families::read_families(file), proposed.families) << "the proposal is there to be edited";
  EXPECT_EQ(group(spec), group(spec)) << "a restart finds what the first attempt wrote and returns the same";

  const std::vector<families::SeedFamily> own = {{"mine", {three_measured()[1].pattern}}};
  write_file_atomically(file, families::to_toml(own));
  EXPECT_EQ(validation_agent::grouping_from(group(spec)).families, own);

  write_file_atomically(file, families::to_toml({{"mine", {pattern::Pattern(0x1ffc9b4ad4d2d9)}}}));
  const auto faulty = validation_agent::grouping_from(group(spec));
  EXPECT_TRUE(faulty.file_is_faulty);
  EXPECT_THAT(faulty.remark, HasSubstr("is not measured in both tests"));
  EXPECT_EQ(faulty.families, proposed.families);
  std::filesystem::remove_all(run);
}

}  // namespace
}  // namespace nacre::game_test
