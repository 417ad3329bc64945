// The farm's core with answers made up by the test, and its work function with real simulations at tiny fidelity.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "crack/crack_record.hpp"
#include "film/film_file.hpp"
#include "material/parameters.hpp"
#include "simulator_farm/farm_core.hpp"
#include "simulator_farm/question.hpp"
#include "simulator_farm/simulate_work.hpp"
#include "wire/schema.hpp"

namespace nacre::simulator_farm {
namespace {

using runtime::Compute;
using runtime::Message;
using runtime::Outputs;
using testing::IsEmpty;
using testing::SizeIs;

wire::SimulateRequest request(const std::string& id, std::vector<pattern::Design> designs, int curve_points = 0) {
  wire::SimulateRequest request;
  request.request_id = id;
  request.modulus = request.toughness = true;
  request.fidelity = tester::Fidelity::tiny;
  request.parameters = material::default_parameters();
  request.curve_points = curve_points;
  request.designs = std::move(designs);
  return request;
}

Outputs ask(FarmCore& farm, const wire::SimulateRequest& request) {
  return farm.step(Message{"SIMULATE", wire::write(request)});
}

// Numbers that only this question has, so that mixed-up answers show.
wire::SimulatedDesign made_up(const wire::SimulateRequest& question) {
  wire::SimulatedDesign answer;
  answer.design = question.designs.front();
  const double mark = 1.0 + answer.design.rigid_fraction();
  if (question.modulus) answer.modulus_pa = 1e9 * mark;
  if (question.toughness) answer.toughness_pa = 1e5 * mark;
  if (question.curve_points > 0) {
    for (int point = 0; point < question.curve_points; ++point) {
      answer.curve.strain.push_back(point);
      answer.curve.stress_pa.push_back(1.0);
    }
  }
  return answer;
}

wire::Fracture made_up_fracture(const wire::SimulateRequest& question) {
  wire::Fracture fracture;
  fracture.design = question.designs.front();
  fracture.crack = {.columns = 10, .rows = 10, .order = {{7, 0.25}}, .path = std::nullopt, .branches = 3};
  fracture.broken = 1;
  if (question.film) fracture.film = "some.film";
  return fracture;
}

/// Like done(), for questions with crack or film.
runtime::WorkDone broken(const Compute& compute) {
  const auto question = wire::read<wire::SimulateRequest>(compute.spec).value();
  Answer answer{made_up(question), std::nullopt};
  if (question.crack || question.film) answer.fracture = made_up_fracture(question);
  return {compute.id, write_answer(answer)};
}

runtime::WorkDone done(const Compute& compute) {
  const auto question = wire::read<wire::SimulateRequest>(compute.spec);
  EXPECT_TRUE(question) << question.error().message;
  return {
      compute.id,
      wire::write(wire::SimulateResult{
          .request_id = question->request_id, .chunk = 0, .chunks = 1, .first = 0, .results = {made_up(*question)}})};
}

std::vector<wire::SimulateResult> answers(const Outputs& outputs) {
  std::vector<wire::SimulateResult> all;
  for (const Message& message : outputs.messages) {
    EXPECT_EQ(message.channel, "SIMULATED");
    EXPECT_LT(message.payload.size(), wire::kMaximumPayload);
    auto part = wire::read<wire::SimulateResult>(message.payload);
    EXPECT_TRUE(part) << part.error().message;
    all.push_back(*part);
  }
  return all;
}

const pattern::Design kSoft = pattern::Mixture{0.0};
const pattern::Design kMixed = pattern::Mixture{0.65};
const pattern::Design kRigid = pattern::Mixture{1.0};

TEST(SimulatorFarm, AnswersComeInTheOrderOfTheRequestWhateverTheOrderOfTheResults) {
  FarmCore farm;
  const std::vector<Compute> computes = ask(farm, request("node/1", {kRigid, kSoft, kMixed})).computes;
  ASSERT_THAT(computes, SizeIs(6)) << "one per design and test";
  Outputs last;
  for (auto compute = computes.rbegin(); compute != computes.rend(); ++compute) {
    EXPECT_THAT(last.messages, IsEmpty());
    last = farm.step(done(*compute));
  }
  const auto parts = answers(last);
  ASSERT_THAT(parts, SizeIs(1));
  ASSERT_THAT(parts[0].results, SizeIs(3));
  EXPECT_EQ(parts[0].results[0].design, kRigid);
  EXPECT_EQ(parts[0].results[0].modulus_pa, 2e9);
  EXPECT_EQ(parts[0].results[1].toughness_pa, 1e5);
  EXPECT_EQ(parts[0].results[2].design, kMixed);
}

TEST(SimulatorFarm, EqualQuestionsOfDifferentRequestsAreComputedOnce) {
  FarmCore farm;
  const auto first = ask(farm, request("a/1", {kRigid, kSoft}));
  const auto second = ask(farm, request("b/1", {kSoft, kRigid, kSoft}));
  EXPECT_THAT(second.computes, IsEmpty());
  std::vector<wire::SimulateResult> all;
  for (const Compute& compute : first.computes) {
    for (const auto& part : answers(farm.step(done(compute)))) all.push_back(part);
  }
  ASSERT_THAT(all, SizeIs(2));
  EXPECT_EQ(all[0].request_id, "a/1");
  EXPECT_EQ(all[1].request_id, "b/1");
  EXPECT_THAT(all[1].results, SizeIs(3));
  EXPECT_EQ(answers(ask(farm, request("c/1", {kRigid}))).size(), 1u) << "an answered question is answered from memory";
}

TEST(SimulatorFarm, ARepeatedRequestIsAnsweredAgainAndAChangedOneRefused) {
  FarmCore farm;
  const auto computes = ask(farm, request("a/1", {kRigid})).computes;
  EXPECT_THAT(ask(farm, request("a/1", {kRigid})).computes, IsEmpty());
  Outputs last;
  for (const Compute& compute : computes) last = farm.step(done(compute));
  EXPECT_EQ(ask(farm, request("a/1", {kRigid})).messages, last.messages);
  const auto changed = ask(farm, request("a/1", {kSoft}));
  EXPECT_THAT(changed.computes, IsEmpty());
  EXPECT_THAT(changed.messages, IsEmpty());
  ASSERT_THAT(changed.log, SizeIs(1));
  EXPECT_EQ(changed.log[0].level, runtime::LogLevel::warning);
}

TEST(SimulatorFarm, ACurveIsFetchedWithoutAskingForTheSameSimulationTwice) {
  FarmCore farm;
  auto toughness = request("a/1", {kRigid});
  toughness.modulus = false;
  const auto plain = ask(farm, toughness).computes;
  ASSERT_THAT(plain, SizeIs(1));
  auto with_curve = request("b/1", {kRigid}, 16);
  with_curve.modulus = false;
  EXPECT_THAT(ask(farm, with_curve).computes, IsEmpty())
      << "the simulation is running: its curve is fetched from the cache later";
  const Outputs settled = farm.step(done(plain[0]));
  EXPECT_EQ(answers(settled).size(), 1u);
  ASSERT_THAT(settled.computes, SizeIs(1));
  EXPECT_NE(settled.computes[0].id, plain[0].id);
  const auto parts = answers(farm.step(done(settled.computes[0])));
  ASSERT_THAT(parts, SizeIs(1));
  EXPECT_EQ(parts[0].request_id, "b/1");
  EXPECT_THAT(parts[0].results[0].curve.strain, SizeIs(16));
}

TEST(SimulatorFarm, AFailedSimulationIsAnAnswerWithItsReason) {
  FarmCore farm;
  auto modulus = request("a/1", {kRigid, kSoft});
  modulus.toughness = false;
  const auto computes = ask(farm, modulus).computes;
  wire::SimulatedDesign failed;
  failed.design = kRigid;
  failed.failure = "J = -0.1 at element 7";
  farm.step(runtime::WorkDone{
      computes[0].id,
      wire::write(wire::SimulateResult{
          .request_id = "simulator_farm/question", .chunk = 0, .chunks = 1, .first = 0, .results = {failed}})});
  const auto parts = answers(farm.step(done(computes[1])));
  ASSERT_THAT(parts, SizeIs(1));
  EXPECT_EQ(parts[0].results[0].failure, "modulus: J = -0.1 at element 7");
  EXPECT_EQ(parts[0].results[1].failure, "");
}

TEST(SimulatorFarm, LongAnswersAreCutIntoMessagesBelowTheLimit) {
  FarmCore farm;
  std::vector<pattern::Design> designs;
  for (int i = 0; i < 60; ++i) designs.emplace_back(pattern::Mixture{0.01 * (i + 1)});
  Outputs last;
  for (const Compute& compute : ask(farm, request("a/1", designs, kCurvePoints)).computes)
    last = farm.step(done(compute));
  const auto parts = answers(last);
  EXPECT_GT(parts.size(), 1u);
  wire::AnswerCollector collector;
  std::optional<std::vector<wire::SimulatedDesign>> whole;
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) whole = collector.add(*part);
  ASSERT_TRUE(whole);
  ASSERT_THAT(*whole, SizeIs(60));
  for (std::size_t i = 0; i < designs.size(); ++i) EXPECT_EQ((*whole)[i].design, designs[i]);
}

TEST(SimulatorFarm, EffectsOfTheTestingMachineAreNoQuestionForTheSimulator) {
  FarmCore farm;
  const auto plain = ask(farm, request("a/1", {kRigid}));
  auto observed = request("b/1", {kRigid});
  observed.parameters.extensions["machine_compliance"] = {1e-10};
  EXPECT_THAT(ask(farm, observed).computes, IsEmpty());
}

TEST(SimulatorFarm, FracturesGoToThoseWhoAskedForThem) {
  FarmCore farm;
  auto plain = request("a/1", {kRigid, kSoft});
  plain.modulus = false;
  const auto first = ask(farm, plain).computes;
  ASSERT_THAT(first, SizeIs(2));
  auto crack = request("b/1", {kSoft, kRigid});
  crack.modulus = false;
  crack.crack = true;
  auto film = request("c/1", {kRigid});
  film.modulus = false;
  film.film = true;
  EXPECT_THAT(ask(farm, crack).computes, IsEmpty())
      << "the simulations are running; what is missing is asked afterwards";
  EXPECT_THAT(ask(farm, film).computes, IsEmpty());
  std::vector<Compute> open = first;
  std::map<std::string, std::vector<wire::Fracture>> fractures;
  std::set<std::string> ids, answered;
  while (!open.empty()) {
    const Compute compute = open.back();
    open.pop_back();
    EXPECT_TRUE(ids.insert(compute.id).second) << "one id, one question: " << compute.id;
    const Outputs outputs = farm.step(broken(compute));
    open.insert(open.end(), outputs.computes.begin(), outputs.computes.end());
    for (const Message& message : outputs.messages) {
      if (message.channel == "SIMULATED")
        answered.insert(wire::read<wire::SimulateResult>(message.payload)->request_id);
      else if (const auto fracture = wire::read<wire::Fracture>(message.payload).value(); message.channel == "FRACTURE")
        fractures[fracture.request_id].push_back(fracture);
    }
  }
  EXPECT_EQ(answered, (std::set<std::string>{"a/1", "b/1", "c/1"}));
  EXPECT_EQ(fractures.count("a/1"), 0u);
  ASSERT_THAT(fractures["b/1"], SizeIs(2));
  EXPECT_EQ(fractures["b/1"][0].design, kSoft);
  EXPECT_EQ(fractures["b/1"][1].design, kRigid);
  EXPECT_EQ(fractures["b/1"][1].design_index, 1);
  EXPECT_EQ(fractures["b/1"][1].film, "") << "whatever others asked";
  ASSERT_THAT(fractures["c/1"], SizeIs(1));
  EXPECT_EQ(fractures["c/1"][0].film, "some.film");
}

TEST(SimulatorFarm, ForeignBytesChangeNothing) {
  FarmCore farm;
  EXPECT_THAT(farm.step(Message{"SIMULATE", "rubbish"}).log, SizeIs(1));
  EXPECT_THAT(farm.step(runtime::WorkDone{"never asked", "rubbish"}).log, SizeIs(1));
  EXPECT_EQ(farm.status().phase, "idle");
}

class SimulateWork : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove_all(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / "nacre_simulate_work_test";
};

TEST_F(SimulateWork, TheSameQuestionIsSimulatedOnceEvenByTwoFarms) {
  auto cache = std::make_shared<store::SimulationCache>(folder_ / "simulations.db");
  const auto question = question_of(request("a/1", {kMixed}), kMixed, tester::TestKind::modulus, {});
  const std::string first = work_functions(cache, folder_ / "films").at("simulate")(wire::write(question));
  EXPECT_EQ(cache->size(), 1);
  auto second_cache = std::make_shared<store::SimulationCache>(folder_ / "simulations.db");
  EXPECT_EQ(work_functions(second_cache, folder_ / "films").at("simulate")(wire::write(question)), first);
  EXPECT_EQ(cache->size(), 1);
  const auto result = wire::read<wire::SimulateResult>(first);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->results.front().modulus_pa, tester::test_modulus(simulation_of(question, kMixed))->modulus_pa);
}

TEST_F(SimulateWork, ToughnessAndCurveAgree) {
  auto cache = std::make_shared<store::SimulationCache>(folder_ / "simulations.db");
  const pattern::Design design = pattern::Pattern(0x577fffe9fffdefULL);
  const auto question = question_of(request("a/1", {design}), design, tester::TestKind::toughness, {.curve = true});
  const auto result =
      wire::read<wire::SimulateResult>(work_functions(cache, folder_ / "films").at("simulate")(wire::write(question)));
  ASSERT_TRUE(result);
  const wire::SimulatedDesign& answer = result->results.front();
  ASSERT_EQ(answer.failure, "");
  ASSERT_THAT(answer.curve.strain, SizeIs(kCurvePoints));
  // The tester records so densely that the area is right to 0.1 %.
  EXPECT_NEAR(tester::area_under(answer.curve), answer.toughness_pa, 1e-3 * answer.toughness_pa);
}

TEST_F(SimulateWork, AFilmIsMadeOnceAndTheCrackIsThatOfTheTest) {
  auto cache = std::make_shared<store::SimulationCache>(folder_ / "simulations.db");
  const pattern::Design design = pattern::Pattern(0x577fffe9fffdefULL);
  const auto plain = question_of(request("a/1", {design}), design, tester::TestKind::toughness, {});
  const auto filmed = question_of(request("a/1", {design}), design, tester::TestKind::toughness, {.film = true});
  const auto work = work_functions(cache, folder_ / "films").at("simulate");
  EXPECT_FALSE(read_answer(work(wire::write(plain)))->fracture) << "nobody asked";
  const std::string bytes = work(wire::write(filmed));
  const Answer answer = read_answer(bytes).value();
  ASSERT_TRUE(answer.fracture);
  const tester::Simulation simulation = simulation_of(filmed, design);
  const auto tested = tester::test_toughness(simulation).value();
  EXPECT_EQ(answer.fracture->broken, static_cast<int>(tested.breaks.size()));
  EXPECT_EQ(answer.fracture->crack.path, crack::record_of(simulation, tested.breaks).path);
  const auto file = folder_ / "films" / answer.fracture->film;
  const film::Film film = film::read_film(file);
  EXPECT_EQ(film.design, design.name());
  EXPECT_EQ(film.crack, answer.fracture->crack);
  EXPECT_EQ(film.frames.size(), static_cast<std::size_t>(film::kFrames));
  const auto written = std::filesystem::last_write_time(file);
  EXPECT_EQ(work(wire::write(filmed)), bytes);
  EXPECT_EQ(std::filesystem::last_write_time(file), written) << "it is there already";
  EXPECT_EQ(cache->size(), 1);
}

TEST_F(SimulateWork, AFailedSimulationHasNoFracture) {
  auto cache = std::make_shared<store::SimulationCache>(folder_ / "simulations.db");
  const auto question = question_of(request("a/1", {kMixed}), kMixed, tester::TestKind::toughness, {.crack = true});
  store::CachedSimulation failed;
  failed.failure = "J <= 0";
  cache->insert(tester::simulation_key(simulation_of(question, kMixed), tester::TestKind::toughness), failed);
  const Answer answer =
      read_answer(work_functions(cache, folder_ / "films").at("simulate")(wire::write(question))).value();
  EXPECT_EQ(answer.design.failure, "J <= 0");
  EXPECT_FALSE(answer.fracture);
}

}  // namespace
}  // namespace nacre::simulator_farm
