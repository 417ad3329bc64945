// Games without the virtual laboratory: the nodes are the real ones, a person brings the measurements and decides.

#include <algorithm>
#include <cmath>
#include <csignal>
#include <memory>
#include <set>

#include "measurement/write_set.hpp"
#include "persons_game.hpp"
#include "program_test.hpp"
#include "run/run.hpp"

namespace nacre {
namespace {

using measurement::SpecimenRecord;
using tester::TestKind;
using testing::Contains;

constexpr const char* kScenario = R"(rounds = 1
fidelity = "tiny"
[diagnosis]
enabled = false
[proposal]
samples = 16
seeds = 1
population = 6
designs = 2
"redraws" = 1
[validation]
random_patterns = 1
replicates = 2
mixtures = []
calibration_evaluations = 3
modulus_evaluations = 12
)";

class InjectedGame : public testing::Test {
 protected:
  void launch(const std::string& name, const std::string& more = "") {
    static const fs::path folder = fresh_folder("games");  // one for all: they share the farm's cache
    person_ = std::make_unique<PersonsGame>(folder, name, kScenario + more);
  }
  void TearDown() override {
    if (HasFailure() && person_) std::fputs(person_->game().said().c_str(), stderr);
  }

  std::unique_ptr<PersonsGame> person_;
};

TEST_F(InjectedGame, GoesOnWithWhatAPersonMeasuresAndTakesEverySpecimenOnce) {
  launch("injected");
  person_->wait_for("orders of round 1", [&] { return person_->orders().size() == 2 * 6; });
  std::vector<SpecimenRecord> whole = person_->measured_in_laboratory();
  ASSERT_EQ(whole.size(), 2U * 2U * 6U);
  for (std::size_t i = 0; i < whole.size(); ++i)
    whole[i].other_columns = {{"date", i % 2 ? "2026-03-13" : "2026-03-12"}, {"path", "along [the] notch; then up"}};
  EXPECT_EQ(person_->inject("part", {whole[2], whole[0]})["accepted"], 2);
  SpecimenRecord changed = whole[0];
  changed.batch += "-9";
  EXPECT_EQ(person_->inject("changed", {changed}, 1)["conflicting"].size(), 1U) << "another one under the same name";
  SpecimenRecord in_gpa;  // kept as not valid, and no person's word makes it count
  in_gpa.specimen = "in-gpa";
  in_gpa.design = pattern::Mixture{0.33};
  in_gpa.modulus_pa = 0.4;
  in_gpa.valid = false;
  EXPECT_EQ(person_->inject("in_gpa", {in_gpa})["accepted"], 1);
  person_->decide({"review", "in-gpa", "--valid", "--why", "looks fine"}, 2);
  const auto delivery = person_->inject("whole", whole);
  EXPECT_EQ(delivery["repeated"], 2) << delivery;
  EXPECT_EQ(delivery["accepted"], whole.size() - 2) << delivery;
  person_->decide({"review", "no-such-specimen", "--invalid", "--why", "a slip"}, 2);
  EXPECT_THAT(run_nacre({"review", "--run", person_->run().string(), "--json"}).out,
              AllOf(HasSubstr("2026-03-13"), HasSubstr(R"("state": "complete")")))
      << "two replicates are what this game orders, and notes keep the days";
  person_->play_to_end();
  EXPECT_EQ(measurements_taken(person_->run()).size(), whole.size() + 1);
  EXPECT_EQ(person_->rounds().size(), 2U);
  for (const char* node : {"validation_agent", "proposal_agent", "simulator_farm", "analyser"}) {
    EXPECT_EQ(run_nacre({"replay", person_->run().string(), "--node", node}).status, 0) << node;
  }
}

TEST_F(InjectedGame, InjectSaysWhenNobodyAnswers) {
  launch("unanswered");
  person_->wait_for("beginning", [&] { return person_->game().said().find("the game begins") != std::string::npos; });
  person_->game().kill_everything();
  const fs::path set = fresh_folder("unheard");
  SpecimenRecord specimen;
  specimen.specimen = "S-1";
  specimen.design = pattern::Mixture{0.5};
  specimen.modulus_pa = 1e9;
  SpecimenRecord in_another_unit = specimen;
  in_another_unit.specimen = "S-2";
  in_another_unit.modulus_pa = 1e6;  // kPa
  measurement::write_measurement_set(set, {specimen, in_another_unit});
  const Outcome outcome = run_nacre({"inject", set.string(), "--run", person_->run().string(), "--timeout-s", "1"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("did not answer"), HasSubstr("specimen S-2 of interface"),
                                 HasSubstr("is a unit wrong"), Not(HasSubstr("specimen S-1 of"))));
}

TEST_F(InjectedGame, InjectSaysWhichNodeHasNotGotTheSpecimensAndASecondTimeBringsThem) {
  launch("half_heard");
  person_->wait_for("orders of round 1", [&] { return person_->orders().size() == 2 * 6; });
  const std::vector<SpecimenRecord> part = {person_->measured_in_laboratory().front()};
  const int analyser = person_->game().process_of("analyser");
  ::kill(analyser, SIGSTOP);
  const fs::path set = fresh_folder("half_heard_set");
  measurement::write_measurement_set(set, part);
  const Outcome outcome =
      run_nacre({"inject", set.string(), "--run", person_->run().string(), "--timeout-s", "2", "--json"});
  ::kill(analyser, SIGCONT);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("analyser did not answer"), Not(HasSubstr("validation_agent did not"))));
  EXPECT_THAT(nlohmann::json::parse(outcome.out)["unanswered_by"], testing::ElementsAre("analyser"));
  EXPECT_EQ(person_->inject("half_heard_again", part)["repeated"], 1);
}

TEST_F(InjectedGame, ASpecimenThatReachedTheAnalyserAloneIsNotReplacedUnderItsName) {
  launch("analyser_alone");
  person_->wait_for("orders of round 1", [&] { return person_->orders().size() == 2 * 6; });
  SpecimenRecord specimen = person_->measured_in_laboratory().front();
  const int agent = person_->game().process_of("validation_agent");
  ::kill(agent, SIGSTOP);
  const fs::path set = fresh_folder("analyser_alone_set");
  measurement::write_measurement_set(set, {specimen});
  const Outcome outcome = run_nacre({"inject", set.string(), "--run", person_->run().string(), "--timeout-s", "2"});
  ::kill(agent, SIGKILL);  // with what waited for it to be read
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("validation_agent did not answer"), Not(HasSubstr("analyser did not"))));
  ASSERT_THAT(measurements_taken(person_->run()), IsEmpty());

  const SpecimenRecord as_it_was = specimen;
  specimen.batch += "-9";
  const fs::path corrected = fresh_folder("analyser_alone_corrected");
  measurement::write_measurement_set(corrected, {specimen});
  const Outcome second = run_nacre({"inject", corrected.string(), "--run", person_->run().string(), "--json"});
  EXPECT_EQ(second.status, 1);
  EXPECT_THAT(second.err, AllOf(HasSubstr("has reached the analyser alone"), HasSubstr("expected a new name")));
  EXPECT_THAT(nlohmann::json::parse(second.out)["conflicting"], testing::ElementsAre(specimen.specimen));
  EXPECT_THAT(measurements_taken(person_->run()), IsEmpty());
  specimen.specimen += "-corrected";
  EXPECT_EQ(person_->inject("analyser_alone_renamed", {specimen})["accepted"], 1);
  EXPECT_EQ(person_->inject("analyser_alone_again", {as_it_was})["accepted"], 1) << "new to the validation agent";
}

/// Specimens of a design in one test, by position.
std::vector<std::size_t> places_of(const std::vector<SpecimenRecord>& specimens, const pattern::Design& design,
                                   TestKind test) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    if (specimens[i].design == design && specimens[i].test == test) places.push_back(i);
  }
  return places;
}

/// Proposals that wait for a person: one approved, one refused, and a replicate that somebody throws out.
class ApprovedGame : public InjectedGame {
 protected:
  void SetUp() override {
    launch("approved", "approval = true\n");
    person_->wait_for("orders without the proposals", [&] { return person_->orders().size() == 2 * 4; });
    const wire::Proposal proposal = person_->proposals().at(0);
    ASSERT_EQ(proposal.designs.size(), 2U);
    approved_ = proposal.designs[0];
    refused_ = proposal.designs[1];
  }
  std::set<std::string> ordered_designs() const {
    std::set<std::string> names;
    for (const wire::TestOrder& order : person_->orders()) names.insert(order.design.name());
    return names;
  }
  void approve_and_refuse() {
    EXPECT_THAT(person_->decide({"approve", approved_.design.name(), "--why", "prints well"}), HasSubstr("approved"));
    EXPECT_THAT(person_->decide({"approve", refused_.design.name(), "--reject", "--why", "islands fall out"}),
                HasSubstr("rejected"));
    person_->wait_for("orders for the approved design", [&] { return person_->orders().size() == 2 * 5; });
  }

  wire::ProposedDesign approved_, refused_;
};

TEST_F(ApprovedGame, OrdersWhatAPersonApprovesAndLeavesOutWhatTheyReviewAsInvalid) {
  EXPECT_THAT(ordered_designs(), AllOf(Not(Contains(approved_.design.name())), Not(Contains(refused_.design.name()))));
  EXPECT_THAT(person_->decide({"approve"}),
              AllOf(HasSubstr(approved_.design.name()), HasSubstr(refused_.design.name())));
  EXPECT_THAT(person_->decide({"approve", "00000000000000"}, 2),
              HasSubstr("not among the designs proposed in round 0"));
  approve_and_refuse();
  EXPECT_THAT(person_->decide({"approve", refused_.design.name()}, 1), HasSubstr("was already rejected by a person"))
      << "too late";
  EXPECT_THAT(person_->decide({"approve", "--add", "rigid"}, 1), HasSubstr("rigid was already ordered"));

  // Everything but one specimen, with an outlier that is thrown out; then the agent dies; then the last specimen.
  std::vector<SpecimenRecord> specimens = person_->measured_in_laboratory();
  ASSERT_EQ(specimens.size(), 2U * 2U * 5U);
  const std::vector<std::size_t> places = places_of(specimens, approved_.design, TestKind::toughness);
  ASSERT_EQ(places.size(), 2U);
  SpecimenRecord& outlier = specimens[places[0]];
  const SpecimenRecord sound = specimens[places[1]];
  const double sound_pa = measurement::toughness_of(sound).value();
  outlier.toughness_pa = 30.0 * sound_pa;
  outlier.curve = {};
  const auto last = std::find_if(specimens.begin(), specimens.end(),
                                 [](const SpecimenRecord& each) { return each.design == pattern::Mixture{0.0}; });
  ASSERT_NE(last, specimens.end());
  const SpecimenRecord missing = *last;
  const std::string outlier_name = outlier.specimen;
  specimens.erase(last);
  EXPECT_EQ(person_->inject("most", specimens)["accepted"], specimens.size());
  const std::string judged = person_->decide({"review", outlier_name, "--invalid", "--why", "thirty times the other"});
  EXPECT_THAT(judged, HasSubstr(outlier_name + ": not valid (revision 1)"));
  EXPECT_THAT(person_->decide({"review", outlier_name, "--valid", "--why", "late", "--revision", "1"}, 1),
              HasSubstr("revision 1 stands"));
  ::kill(person_->game().process_of("validation_agent"), SIGKILL);
  person_->inject("last", {missing});
  person_->play_to_end();

  EXPECT_THAT(ordered_designs(), Not(Contains(refused_.design.name()))) << "the first decision counts";
  const wire::RoundSummary round = person_->rounds().at(1);
  EXPECT_EQ(round.calibration_count, 2) << "the approved design and the random pattern";
  EXPECT_EQ(round.held_out.toughness_count, 1);
  EXPECT_NEAR(round.held_out.toughness_mean, std::abs(approved_.toughness_pa - sound_pa) / sound_pa, 1e-9);
  const wire::Proposal second = person_->proposals().at(1);
  for (const wire::ProposedDesign& next : second.designs) {
    EXPECT_NE(next.design, refused_.design) << "what was refused is not proposed again";
  }
  const auto record = run::Run(person_->run()).record();
  for (const run::MeasuredSpecimen& kept : record->specimens) {
    EXPECT_EQ(kept.record.valid, kept.record.specimen != outlier_name) << kept.record.specimen;
  }
}

}  // namespace
}  // namespace nacre
