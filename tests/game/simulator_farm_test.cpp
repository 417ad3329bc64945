// The farm's core with responses made up by the test, and its work function with real simulations at tiny fidelity.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/files.hpp"
#include "crack/crack_record.hpp"
#include "film/film_file.hpp"
#include "material/parameters.hpp"
#include "simulator_farm/farm_core.hpp"
#include "simulator_farm/simulate_work.hpp"
#include "simulator_farm/slurm_executor.hpp"
#include "simulator_farm/test_request.hpp"
#include "tester/simulation_key.hpp"
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

// Numbers that only this test has, so that mixed-up responses show.
wire::SimulatedDesign made_up(const wire::SimulateRequest& test_request) {
  wire::SimulatedDesign response;
  response.design = test_request.designs.front();
  const double mark = 1.0 + response.design.rigid_fraction();
  if (test_request.modulus) response.modulus_pa = 1e9 * mark;
  if (test_request.toughness) response.toughness_pa = 1e5 * mark;
  if (test_request.curve_points > 0) {
    for (int point = 0; point < test_request.curve_points; ++point) {
      response.curve.strain.push_back(point);
      response.curve.stress_pa.push_back(1.0);
    }
  }
  return response;
}

wire::Fracture made_up_fracture(const wire::SimulateRequest& test_request) {
  wire::Fracture fracture;
  fracture.design = test_request.designs.front();
  fracture.crack = {.columns = 10, .rows = 10, .order = {{7, 0.25}}, .path = std::nullopt, .branches = 3};
  fracture.broken = 1;
  if (test_request.film) fracture.film = "some.film";
  return fracture;
}

/// Like done(), for test requests with crack or film.
runtime::WorkDone broken(const Compute& compute) {
  const auto test_request = wire::read<wire::SimulateRequest>(compute.spec).value();
  TestResponse response{made_up(test_request), std::nullopt};
  if (test_request.crack || test_request.film) response.fracture = made_up_fracture(test_request);
  return {compute.id, write_response(response)};
}

runtime::WorkDone done(const Compute& compute) {
  const auto test_request = wire::read<wire::SimulateRequest>(compute.spec);
  EXPECT_TRUE(test_request) << test_request.error().message;
  return {compute.id, wire::write(wire::SimulateResult{.request_id = test_request->request_id,
                                                       .chunk = 0,
                                                       .chunks = 1,
                                                       .first = 0,
                                                       .results = {made_up(*test_request)}})};
}

std::vector<wire::SimulateResult> responses(const Outputs& outputs) {
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

TEST(SimulatorFarm, ResponsesComeInTheOrderOfTheRequestWhateverTheOrderOfTheResults) {
  FarmCore farm;
  const std::vector<Compute> computes = ask(farm, request("node/1", {kRigid, kSoft, kMixed})).computes;
  ASSERT_THAT(computes, SizeIs(6)) << "one per design and test";
  Outputs last;
  for (auto compute = computes.rbegin(); compute != computes.rend(); ++compute) {
    EXPECT_THAT(last.messages, IsEmpty());
    last = farm.step(done(*compute));
  }
  const auto parts = responses(last);
  ASSERT_THAT(parts, SizeIs(1));
  ASSERT_THAT(parts[0].results, SizeIs(3));
  EXPECT_EQ(parts[0].results[0].design, kRigid);
  EXPECT_EQ(parts[0].results[0].modulus_pa, 2e9);
  EXPECT_EQ(parts[0].results[1].toughness_pa, 1e5);
  EXPECT_EQ(parts[0].results[2].design, kMixed);
}

wire::SimulateRequest specimens_from(const std::string& id, int first, int count, double strength_cv = 0.1) {
  wire::SimulateRequest wanted = request(id, {kMixed}, 8);
  wanted.modulus = false;
  wanted.parameters.strength_cv = strength_cv;
  wanted.first_specimen = first;
  wanted.specimens = count;
  return wanted;
}

/// T is its number in units of 100 kPa.
runtime::WorkDone specimen_done(const Compute& compute) {
  const auto test_request = wire::read<wire::SimulateRequest>(compute.spec).value();
  EXPECT_EQ(test_request.specimens, 1);
  TestResponse response{made_up(test_request), std::nullopt};
  response.design.toughness_pa = 1e5 * test_request.first_specimen;
  return {compute.id, write_response(response)};
}

TEST(SimulatorFarm, TIsTheMeanOverSpecimensAndTheCurveTheFirstOnes) {
  FarmCore farm;
  const std::vector<Compute> computes = ask(farm, specimens_from("node/1", 4, 3)).computes;
  ASSERT_THAT(computes, SizeIs(3));
  Outputs last;
  for (auto compute = computes.rbegin(); compute != computes.rend(); ++compute)
    last = farm.step(specimen_done(*compute));
  const wire::SimulatedDesign result = responses(last).at(0).results.at(0);
  EXPECT_EQ(result.toughness_pa, 5e5);
  EXPECT_EQ(result.toughness_sd_pa, 1e5);
  EXPECT_EQ(result.specimens, 3);
  EXPECT_EQ(result.curve.size(), 8u);
  // Of specimens 5 and 6 all but the curve of the first is known.
  const std::vector<Compute> more = ask(farm, specimens_from("node/2", 5, 2)).computes;
  ASSERT_THAT(more, SizeIs(1));
  EXPECT_EQ(responses(farm.step(specimen_done(more[0]))).at(0).results.at(0).toughness_pa, 5.5e5);
}

TEST(SimulatorFarm, OneOfAlikeSpecimensStandsForAll) {
  FarmCore farm;
  const std::vector<Compute> computes = ask(farm, specimens_from("node/1", 4, 3, 0.0)).computes;
  ASSERT_THAT(computes, SizeIs(1));
  const wire::SimulatedDesign result = responses(farm.step(done(computes[0]))).at(0).results.at(0);
  EXPECT_EQ(result.specimens, 3);
  EXPECT_EQ(result.toughness_sd_pa, 0.0);
}

TEST(SimulatorFarm, ASpecimenThatCannotBeTestedIsNamed) {
  FarmCore farm;
  const std::vector<Compute> computes = ask(farm, specimens_from("node/1", 4, 2)).computes;
  farm.step(specimen_done(computes[0]));
  TestResponse failed;
  failed.design.design = kMixed;
  failed.design.failure = "J <= 0";
  const auto parts = responses(farm.step(runtime::WorkDone{computes[1].id, write_response(failed)}));
  EXPECT_EQ(parts.at(0).results.at(0).failure, "toughness of specimen 5: J <= 0");
}

TEST(SimulatorFarm, EqualTestsOfDifferentRequestsAreComputedOnce) {
  FarmCore farm;
  const auto first = ask(farm, request("a/1", {kRigid, kSoft}));
  const auto second = ask(farm, request("b/1", {kSoft, kRigid, kSoft}));
  EXPECT_THAT(second.computes, IsEmpty());
  std::vector<wire::SimulateResult> all;
  for (const Compute& compute : first.computes) {
    for (const auto& part : responses(farm.step(done(compute)))) all.push_back(part);
  }
  ASSERT_THAT(all, SizeIs(2));
  EXPECT_EQ(all[0].request_id, "a/1");
  EXPECT_EQ(all[1].request_id, "b/1");
  EXPECT_THAT(all[1].results, SizeIs(3));
  EXPECT_EQ(responses(ask(farm, request("c/1", {kRigid}))).size(), 1u) << "a test that is done is not simulated again";
}

TEST(SimulatorFarm, ARepeatedRequestGetsItsResponseAgainAndAChangedOneIsRefused) {
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

// Of a requester that lost its journal and takes another course the second time.
TEST(SimulatorFarm, AnotherRequestAtTheSamePlaceGetsAResponseUnderItsOwnId) {
  FarmCore farm;
  const auto before = wire::with_content_id(request("a/1", {kRigid}));
  const auto now = wire::with_content_id(request("a/1", {kSoft}));
  for (const Compute& compute : ask(farm, before).computes) farm.step(done(compute));
  const Outputs asked = ask(farm, now);
  EXPECT_THAT(asked.log, IsEmpty());
  ASSERT_THAT(asked.computes, SizeIs(2));
  Outputs last;
  for (const Compute& compute : asked.computes) last = farm.step(done(compute));
  const auto parts = responses(last);
  ASSERT_THAT(parts, SizeIs(1));
  EXPECT_EQ(parts[0].request_id, now.request_id);
  EXPECT_EQ(parts[0].results.at(0).design, kSoft);
  EXPECT_EQ(responses(ask(farm, before)).at(0).results.at(0).design, kRigid);
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
  EXPECT_EQ(responses(settled).size(), 1u);
  ASSERT_THAT(settled.computes, SizeIs(1));
  EXPECT_NE(settled.computes[0].id, plain[0].id);
  const auto parts = responses(farm.step(done(settled.computes[0])));
  ASSERT_THAT(parts, SizeIs(1));
  EXPECT_EQ(parts[0].request_id, "b/1");
  EXPECT_THAT(parts[0].results[0].curve.strain, SizeIs(16));
}

TEST(SimulatorFarm, AFailedSimulationIsAResponseWithItsReason) {
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
  const auto parts = responses(farm.step(done(computes[1])));
  ASSERT_THAT(parts, SizeIs(1));
  EXPECT_EQ(parts[0].results[0].failure, "modulus: J = -0.1 at element 7");
  EXPECT_EQ(parts[0].results[1].failure, "");
}

TEST(SimulatorFarm, LongResponsesAreCutIntoMessagesBelowTheLimit) {
  FarmCore farm;
  std::vector<pattern::Design> designs;
  for (int i = 0; i < 60; ++i) designs.emplace_back(pattern::Mixture{0.01 * (i + 1)});
  Outputs last;
  for (const Compute& compute : ask(farm, request("a/1", designs, kCurvePoints)).computes)
    last = farm.step(done(compute));
  const auto parts = responses(last);
  EXPECT_GT(parts.size(), 1u);
  wire::ResponseCollector collector;
  std::optional<std::vector<wire::SimulatedDesign>> whole;
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) whole = collector.add(*part);
  ASSERT_TRUE(whole);
  ASSERT_THAT(*whole, SizeIs(60));
  for (std::size_t i = 0; i < designs.size(); ++i) EXPECT_EQ((*whole)[i].design, designs[i]);
}

TEST(SimulatorFarm, EffectsOfTheTestingMachineAreNotRequestedFromTheSimulator) {
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
    EXPECT_TRUE(ids.insert(compute.id).second) << "one id, one test request: " << compute.id;
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

TEST(SimulatorFarm, ACrackThatCannotBeToldTakesNoNumbersAway) {
  FarmCore farm;
  auto numbers = request("a/1", {kMixed}), crack = request("b/1", {kMixed}), later = request("c/1", {kMixed});
  for (wire::SimulateRequest* each : {&numbers, &crack, &later}) each->modulus = false;
  crack.crack = true;
  const Compute first = ask(farm, numbers).computes.at(0);
  ASSERT_THAT(responses(farm.step(done(first))), SizeIs(1));
  const Compute second = ask(farm, crack).computes.at(0);
  TestResponse failed;
  failed.design.design = kMixed;
  failed.design.failure = "the crack cannot be told";
  const auto told = responses(farm.step(runtime::WorkDone{second.id, write_response(failed)}));
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_THAT(told[0].results.at(0).failure, testing::HasSubstr("cannot be told"))
      << "whoever requested it is told why";
  const Outputs again = ask(farm, later);
  EXPECT_THAT(again.computes, IsEmpty());
  ASSERT_THAT(responses(again), SizeIs(1));
  EXPECT_EQ(responses(again)[0].results.at(0).failure, "");
  EXPECT_GT(responses(again)[0].results.at(0).toughness_pa, 0.0);
  crack.request_id = "d/1";
  EXPECT_THAT(responses(ask(farm, crack)).at(0).results.at(0).failure, testing::HasSubstr("cannot be told"));
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

TEST_F(SimulateWork, TheSameTestIsSimulatedOnceEvenByTwoFarms) {
  auto cache = std::make_shared<store::SimulationCache>(folder_ / "simulations.db");
  const auto test_request = test_request_of(request("a/1", {kMixed}), kMixed, {tester::TestKind::modulus, 0, {}});
  const std::string first = work_functions(cache, folder_ / "films").at("simulate")(wire::write(test_request));
  EXPECT_EQ(cache->size(), 1);
  auto second_cache = std::make_shared<store::SimulationCache>(folder_ / "simulations.db");
  EXPECT_EQ(work_functions(second_cache, folder_ / "films").at("simulate")(wire::write(test_request)), first);
  EXPECT_EQ(cache->size(), 1);
  const auto result = wire::read<wire::SimulateResult>(first);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->results.front().modulus_pa, tester::test_modulus(simulation_of(test_request, kMixed))->modulus_pa);
}

TEST_F(SimulateWork, ToughnessAndCurveAgree) {
  auto cache = std::make_shared<store::SimulationCache>(folder_ / "simulations.db");
  const pattern::Design design = pattern::Pattern(0x577fffe9fffdefULL);
  const auto test_request =
      test_request_of(request("a/1", {design}), design, {tester::TestKind::toughness, 0, {.curve = true}});
  const auto result = wire::read<wire::SimulateResult>(
      work_functions(cache, folder_ / "films").at("simulate")(wire::write(test_request)));
  ASSERT_TRUE(result);
  const wire::SimulatedDesign& response = result->results.front();
  ASSERT_EQ(response.failure, "");
  ASSERT_THAT(response.curve.strain, SizeIs(kCurvePoints));
  // The tester records so densely that the area is right to 0.1 %.
  EXPECT_NEAR(tester::area_under(response.curve), response.toughness_pa, 1e-3 * response.toughness_pa);
}

TEST_F(SimulateWork, AFilmIsMadeOnceAndTheCrackIsThatOfTheTest) {
  auto cache = std::make_shared<store::SimulationCache>(folder_ / "simulations.db");
  const pattern::Design design = pattern::Pattern(0x577fffe9fffdefULL);
  const auto plain = test_request_of(request("a/1", {design}), design, {tester::TestKind::toughness, 0, {}});
  const auto filmed =
      test_request_of(request("a/1", {design}), design, {tester::TestKind::toughness, 0, {.film = true}});
  const auto work = work_functions(cache, folder_ / "films").at("simulate");
  EXPECT_FALSE(read_response(work(wire::write(plain)))->fracture) << "nobody asked";
  const std::string bytes = work(wire::write(filmed));
  const TestResponse response = read_response(bytes).value();
  ASSERT_TRUE(response.fracture);
  const tester::Simulation simulation = simulation_of(filmed, design);
  const auto tested = tester::test_toughness(simulation).value();
  EXPECT_EQ(response.fracture->broken, static_cast<int>(tested.breaks.size()));
  EXPECT_EQ(response.fracture->crack.path, crack::record_of(simulation, tested.breaks).path);
  const auto file = folder_ / "films" / response.fracture->film;
  const film::Film film = film::read_film(file);
  EXPECT_EQ(film.design, design.name());
  EXPECT_EQ(film.crack, response.fracture->crack);
  EXPECT_EQ(film.frames.size(), static_cast<std::size_t>(film::kFrames));
  const auto written = std::filesystem::last_write_time(file);
  EXPECT_EQ(work(wire::write(filmed)), bytes);
  EXPECT_EQ(std::filesystem::last_write_time(file), written) << "it is there already";
  EXPECT_EQ(cache->size(), 1);
}

TEST_F(SimulateWork, AFailedSimulationHasNoFracture) {
  auto cache = std::make_shared<store::SimulationCache>(folder_ / "simulations.db");
  const auto test_request =
      test_request_of(request("a/1", {kMixed}), kMixed, {tester::TestKind::toughness, 0, {.crack = true}});
  store::CachedSimulation failed;
  failed.failure = "J <= 0";
  cache->insert(tester::simulation_key(simulation_of(test_request, kMixed), tester::TestKind::toughness), failed);
  const TestResponse response =
      read_response(work_functions(cache, folder_ / "films").at("simulate")(wire::write(test_request))).value();
  EXPECT_EQ(response.design.failure, "J <= 0");
  EXPECT_FALSE(response.fracture);
}

/// A cache whose numbers are not this program's: a device rounds otherwise, and cracks hinge on rounding.
class NumbersFromElsewhere : public SimulateWork {
 protected:
  void SetUp() override {
    SimulateWork::SetUp();
    cache_ = std::make_shared<store::SimulationCache>(folder_ / "simulations.db");
    tested_ = tester::test_toughness(simulation_).value();
  }
  /// The numbers of this program, toughness times `factor`.
  store::CachedSimulation numbers(double factor) const {
    store::CachedSimulation numbers = store::kept(Result<tester::ToughnessResult>(tested_));
    numbers.toughness_pa *= factor;
    return numbers;
  }
  TestResponse response(const Extras& extras) const {
    const auto test_request =
        test_request_of(request("a/1", {kDesign}), kDesign, {tester::TestKind::toughness, 0, extras});
    return read_response(simulate_work(*cache_, folder_ / "films", wire::write(test_request))).value();
  }

  const pattern::Design kDesign = pattern::Pattern(0x577fffe9fffdefULL);
  const tester::Simulation simulation_ = simulation_of(request("a/1", {kDesign}), kDesign);
  const std::string key_ = tester::simulation_key(simulation_, tester::TestKind::toughness);
  std::shared_ptr<store::SimulationCache> cache_;
  tester::ToughnessResult tested_;
};

TEST_F(NumbersFromElsewhere, ACrackThatIsNotTheirsIsAFailureWithItsReason) {
  cache_->insert(key_, numbers(1.5));
  const TestResponse cracked = response({.crack = true});
  EXPECT_THAT(cracked.design.failure, testing::HasSubstr("crack cannot be told"));
  EXPECT_FALSE(cracked.fracture);
  EXPECT_FALSE(cache_->find_breaks(key_)) << "they would be taken for those of the numbers";
  const TestResponse plain = response({});
  EXPECT_EQ(plain.design.failure, "") << "the numbers are as good as they were";
  EXPECT_EQ(plain.design.toughness_pa, 1.5 * tested_.toughness_pa);
}

TEST_F(NumbersFromElsewhere, ACrackIsTheirsWhenOnlyRoundingTellsThemApart) {
  cache_->insert(key_, numbers(1.001));
  const TestResponse cracked = response({.crack = true});
  EXPECT_EQ(cracked.design.toughness_pa, 1.001 * tested_.toughness_pa);
  ASSERT_TRUE(cracked.fracture) << cracked.design.failure;
  EXPECT_EQ(cracked.fracture->broken, static_cast<int>(tested_.breaks.size()));
}

TEST_F(NumbersFromElsewhere, AFilmOfOtherNumbersIsNotKept) {
  keep_response(*cache_, key_, numbers(1.5), &tested_.breaks);
  const TestResponse filmed = response({.crack = true, .film = true});
  EXPECT_EQ(filmed.design.toughness_pa, 1.5 * tested_.toughness_pa);
  ASSERT_TRUE(filmed.fracture);
  EXPECT_EQ(filmed.fracture->film, "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "films" / (key_ + ".film")));
}

TEST_F(NumbersFromElsewhere, AFilmOfAnotherCrackIsNotKeptThoughNumbersAgree) {
  std::vector<tester::Break> some = tested_.breaks;
  some.resize(some.size() / 2);
  keep_response(*cache_, key_, numbers(1.0), &some);
  const TestResponse filmed = response({.film = true});
  ASSERT_TRUE(filmed.fracture);
  EXPECT_EQ(filmed.fracture->broken, static_cast<int>(some.size()));
  EXPECT_EQ(filmed.fracture->film, "");
}

TEST_F(NumbersFromElsewhere, AFilmIsTheirsWhenOnlyRoundingTellsThemApart) {
  keep_response(*cache_, key_, numbers(0.999), &tested_.breaks);
  const TestResponse filmed = response({.film = true});
  ASSERT_TRUE(filmed.fracture);
  EXPECT_EQ(filmed.fracture->film, key_ + ".film");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "films" / filmed.fracture->film));
}

TEST_F(SimulateWork, BreaksAreKeptWithTheNumbersOfTheirFractureAlone) {
  store::SimulationCache cache(folder_ / "simulations.db");
  store::CachedSimulation first, other;
  first.toughness_pa = other.toughness_pa = 2e5;
  first.peak_stress_pa = other.peak_stress_pa = 1e7;
  first.failure_strain = 0.02;
  other.failure_strain = 0.03;
  const std::vector<tester::Break> breaks = {{7, 0.015625}}, of_another = {{8, 0.015625}};
  EXPECT_TRUE(keep_response(cache, "key", first, nullptr));
  EXPECT_FALSE(keep_response(cache, "key", other, &of_another));
  EXPECT_FALSE(cache.find_breaks("key"));
  EXPECT_FALSE(keep_response(cache, "key", first, &breaks));
  EXPECT_EQ(cache.find_breaks("key"), breaks);
  EXPECT_EQ(cache.find("key")->failure_strain, first.failure_strain);
}

/// A cluster that takes every task and forgets it: Slurm's commands as programs that do nothing.
class ForgetfulSlurm : public SimulateWork {
 protected:
  void SetUp() override {
    SimulateWork::SetUp();
    std::filesystem::create_directories(folder_ / "bin");
    for (const char* command : {"sbatch", "squeue"}) {
      std::ofstream(folder_ / "bin" / command) << "#!/bin/sh\nexit 0\n";
      std::filesystem::permissions(folder_ / "bin" / command, std::filesystem::perms::owner_all);
    }
    path_ = std::getenv("PATH");
    ::setenv("PATH", ((folder_ / "bin").string() + ":" + path_).c_str(), 1);
  }
  void TearDown() override {
    executor_.reset();
    ::setenv("PATH", path_.c_str(), 1);
    SimulateWork::TearDown();
  }
  void open_executor() {
    executor_ = std::make_unique<SlurmExecutor>(std::make_shared<store::SimulationCache>(folder_ / "simulations.db"),
                                                SlurmSettings{.spool = folder_ / "slurm",
                                                              .films = folder_ / "films",
                                                              .program = "no_program",
                                                              .gather_s = 0.0,
                                                              .poll_s = 0.05,
                                                              .patience = {.listing_s = 0.05, .sign_s = 100.0},
                                                              .most_attempts = 1000},
                                                [] {});
  }
  static bool becomes_true(const std::function<bool()>& condition) {
    for (int turn = 0; turn < 3000 && !condition(); ++turn) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return condition();
  }

  std::string path_;
  std::unique_ptr<SlurmExecutor> executor_;
};

TEST_F(ForgetfulSlurm, ABatchThatIsGivenOutAgainHasItsFileAgain) {
  open_executor();
  const auto test_request = test_request_of(request("a/1", {kMixed}), kMixed, {tester::TestKind::modulus, 0, {}});
  executor_->start({"q", "simulate", wire::write(test_request)});
  const Spool spool(folder_ / "slurm");
  ASSERT_TRUE(becomes_true([&] { return !spool.batches().empty(); }));
  const std::filesystem::path file = spool.batch_file(spool.batches().front());
  const std::string bytes = read_file(file);
  std::filesystem::remove(file);
  ASSERT_TRUE(becomes_true([&] { return std::filesystem::exists(file); })) << "its tasks would find nothing to do";
  EXPECT_EQ(read_file(file), bytes);
}

}  // namespace
}  // namespace nacre::simulator_farm
