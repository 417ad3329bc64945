// The family stage with the real programs at tiny fidelity: over messages to its end, and the same when the validation
// agent is killed in its midst.

#include <csignal>
#include <fstream>
#include <memory>
#include <set>

#include "game/family_errors.hpp"
#include "played_game.hpp"
#include "program_test.hpp"
#include "run/run.hpp"
#include "runtime/journal.hpp"
#include "runtime/round_history.hpp"
#include "short_game.hpp"

namespace nacre {
namespace {

constexpr double kPatienceS = 240.0;  // for one game, on a machine that does other things too

const std::string kStage = R"(
[families]
enabled = true
rank = 1
samples = 8
designs = 1
calibration_evaluations = 4
modulus_evaluations = 16
)";

/// One game is played undisturbed; the other is compared with it and finds its simulations in the farm's cache.
class FamilyStageOfProcesses : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fresh_folder("family_stage");
    std::ofstream(folder_ / "families.toml") << short_game("families", 1) << kStage;
    undisturbed_ = play("undisturbed");
    undisturbed_->play_to_end(kPatienceS);
  }
  static void TearDownTestSuite() { undisturbed_.reset(); }
  void SetUp() override { ASSERT_EQ(undisturbed_->status(), 0) << undisturbed_->said(); }

  static std::unique_ptr<PlayedGame> play(const std::string& name) {
    return std::make_unique<PlayedGame>(folder_ / "families.toml", folder_ / "logs", name);
  }
  /// What the validation agent has said on a channel.
  template <class Message>
  static std::vector<Message> said(const std::string& channel) {
    std::vector<Message> messages;
    for (const std::string& payload :
         journaled(undisturbed_->folder(), "validation_agent", std::string(runtime::kOutPrefix) + channel))
      messages.push_back(wire::read<Message>(payload).value());
    return messages;
  }
  static std::vector<wire::CalibratedFamily> families(bool validated) {
    std::vector<wire::CalibratedFamily> all = said<wire::CalibratedFamily>("FAMILY");
    std::erase_if(all, [&](const wire::CalibratedFamily& family) { return family.is_validated != validated; });
    return all;
  }

  static fs::path folder_;
  static std::unique_ptr<PlayedGame> undisturbed_;
};

fs::path FamilyStageOfProcesses::folder_;
std::unique_ptr<PlayedGame> FamilyStageOfProcesses::undisturbed_;

TEST_F(FamilyStageOfProcesses, FollowsTheLastRoundAndEndsTheGame) {
  const auto rounds = said<wire::RoundSummary>("ROUND");
  ASSERT_EQ(rounds.size(), 3U);
  EXPECT_FALSE(rounds[1].last) << "the stage follows";
  EXPECT_TRUE(rounds[2].last);
  EXPECT_EQ(rounds[2].round, rounds[1].round);
  EXPECT_FALSE(families(false).empty());
  EXPECT_EQ(families(false).size(), families(true).size()) << "each is said when chosen and when measured";
  EXPECT_THAT(undisturbed_->said(), HasSubstr("the game is over"));
}

TEST_F(FamilyStageOfProcesses, EveryVariantChosenIsOrderedAndMeasuredInBothTests) {
  std::set<std::string> chosen;
  int round = -1;
  for (const wire::CalibratedFamily& family : families(false)) {
    round = family.round;
    for (const game::FamilyDesign& design : family.designs)
      if (!design.is_seed) chosen.insert(design.pattern.key());
  }
  EXPECT_FALSE(chosen.empty());
  std::map<std::string, int> ordered, measured;
  for (const wire::TestOrder& order : said<wire::TestOrder>("TEST_ORDER"))
    if (order.round == round) ordered[order.design.name()] += order.replicates;
  for (const wire::Measurement& taken : measurements_taken(undisturbed_->folder()))
    if (taken.round == round) ++measured[taken.record.design.name()];
  for (const std::string& design : chosen) EXPECT_EQ(ordered[design], 4) << design << ": two of each test";
  EXPECT_EQ(ordered.size(), chosen.size()) << "nothing else in the stage's round";
  EXPECT_EQ(measured, ordered);
}

TEST_F(FamilyStageOfProcesses, TheResultHoldsTheErrorsOfBothModels) {
  for (const wire::CalibratedFamily& family : families(true)) {
    const game::FamilyErrors errors = game::family_errors(family.designs);
    for (const sysid::PredictionErrors& each :
         {errors.seeds_global, errors.seeds_family, errors.chosen_global, errors.chosen_family}) {
      EXPECT_GT(each.modulus_count, 0) << family.name;
      EXPECT_GT(each.toughness_count, 0) << family.name;
      EXPECT_GT(each.modulus_mean, 0.0) << family.name;
    }
    EXPECT_NE(errors.chosen_global, errors.chosen_family) << family.name << ": the two models are not the same";
    EXPECT_GT(family.simulations, 0);
  }
}

TEST_F(FamilyStageOfProcesses, TheDatabaseHoldsWhatWasSaid) {
  const run::RunRecord run = run::Run(undisturbed_->folder()).record_with_gamuts();
  const auto stated = families(true);
  ASSERT_EQ(run.families.size(), stated.size());
  for (std::size_t i = 0; i < stated.size(); ++i) {
    EXPECT_EQ(run.families[i].stated.designs, stated[i].designs);
    EXPECT_TRUE(run.families[i].stated.is_validated);
    EXPECT_EQ(run.families[i].gamut->patterns.size(), static_cast<std::size_t>(stated[i].samples));
    EXPECT_GT(stated[i].samples, 0);
  }
}

/// Kills the validation agent once when the game has said so.
struct Kill {
  std::string when_said;
  int process = 0;
};

TEST_F(FamilyStageOfProcesses, AKilledValidationAgentGoesOnWithTheSameStage) {
  const auto game = play("killed");
  // While the first family is worked out, and while its designs are measured.
  std::vector<Kill> kills = {{"family stage: "}, {"; errors on the seeds: global model"}};
  const auto kill_when_due = [&] {
    for (std::size_t i = 0; i < kills.size(); ++i) {
      if (kills[i].process != 0 || game->said().find(kills[i].when_said) == std::string::npos) continue;
      const int process = game->process_of("validation_agent");
      if (process == 0 || (i > 0 && process == kills[i - 1].process)) continue;
      if (::kill(process, SIGKILL) == 0) kills[i].process = process;
    }
  };
  ASSERT_TRUE(game->play_to_end(kPatienceS, kill_when_due)) << game->said();
  ASSERT_EQ(game->status(), 0) << game->said();
  for (const Kill& kill : kills) EXPECT_NE(kill.process, 0) << kill.when_said;
  EXPECT_THAT(game->said(), HasSubstr("validation_agent died (killed by SIGKILL"));
  EXPECT_THAT(differences(sent_in_game(undisturbed_->folder()), sent_in_game(game->folder())), IsEmpty());
  const Outcome replay = run_nacre({"replay", game->folder().string(), "--node", "validation_agent"});
  EXPECT_EQ(replay.status, 0) << replay.out << replay.err;
}

}  // namespace
}  // namespace nacre
