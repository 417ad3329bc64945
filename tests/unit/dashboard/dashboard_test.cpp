#include "dashboard/dashboard.hpp"

#include <unistd.h>

#include <cstring>
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../wire/samples.hpp"
#include "base/files.hpp"
#include "base/result.hpp"
#include "crack/mechanisms.hpp"
#include "dashboard/server.hpp"
#include "dashboard/several_runs.hpp"
#include "fake_desk.hpp"
#include "families/families_file.hpp"
#include "material/parameter_file.hpp"
#include "run/run_database.hpp"
#include "tester/toughness.hpp"

namespace nacre::dashboard {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A run's folder with the messages of the samples in its database, and a desk that keeps what is entered.
class DashboardOfARun : public testing::Test {
 protected:
  DashboardOfARun() {
    fs::create_directories(folder_ / "films");
    fs::create_directories(folder_ / "page");
    std::ofstream(folder_ / "page" / "index.html") << "<p>page</p>";
    std::ofstream(folder_ / "secret.toml") << "hidden";
    run::RunDatabase database(folder_ / "run.db");
    for (const auto& [channel, payload] : wire::samples::payloads()) database.keep(channel, payload);
    for (int chunk = 0; chunk < 3; ++chunk) database.keep("GAMUT", wire::write(gamut_chunk(chunk)));
    database.checkpoint();
    dashboard_.emplace(settings(), desk_);
    page_.emplace(folder_ / "page",
                  std::vector<ShownRun>{{"broken", nullptr, "run.db: is no database"}, {"game", &*dashboard_}});
  }
  ~DashboardOfARun() override { fs::remove_all(folder_); }

  static wire::GamutChunk gamut_chunk(int chunk) {
    wire::GamutChunk gamut{.round = 7, .fidelity = tester::Fidelity::tiny, .chunk = chunk, .chunks = 3, .samples = {}};
    for (std::uint64_t i = 0; i < 10; ++i)
      gamut.samples.push_back({pattern::Pattern(0x577fffe9fffdef ^ (1ull << (10 * static_cast<unsigned>(chunk) + i))),
                               {1e9 + 1e7 * double(i), 5e5 - 1e3 * double(i * i)}});
    return gamut;
  }

  Response get(const std::string& path, std::map<std::string, std::string> query = {}) {
    return page_->handle({.method = "GET", .path = path, .query = std::move(query), .headers = {}, .body = ""});
  }
  Response post(const std::string& path, const std::string& body, std::map<std::string, std::string> query = {}) {
    return page_->handle({.method = "POST", .path = path, .query = std::move(query), .headers = {}, .body = body});
  }
  Json json(const std::string& path, std::map<std::string, std::string> query = {}) {
    return Json::parse(get(path, std::move(query)).body);
  }

  /// A film that the game made of a design by the model of family-2; returns the design's name.
  std::string film_of_the_stage() {
    run::RunDatabase database(folder_ / "run.db");
    wire::Fracture fracture = wire::samples::fracture();
    fracture.request_id = fmt::format("analyser/family{}/films", wire::samples::family().number);
    database.keep("FRACTURE", wire::write(fracture));
    std::ofstream(folder_ / "films" / fracture.film) << "NACREFLM of the game";
    return fracture.design.name();
  }

  /// family-2 as `nacre families` leaves it; at `times` 1 its model is that of the stage.
  void keep_model_in_folder(double times) {
    material::ParameterSet parameters = wire::samples::family().parameters;
    parameters.toughness.w_if_j_per_m3 *= times;
    fs::create_directories(folder_ / "families" / "family-2");
    std::ofstream(folder_ / "families" / "family-2" / "parameters.toml") << material::to_toml(parameters);
  }

  DashboardSettings settings() const {
    DashboardSettings settings;
    settings.run_folder = folder_;
    settings.family_folder = folder_ / "families";
    settings.scenario.fidelity = tester::Fidelity::tiny;
    return settings;
  }

  fs::path folder_ = fs::temp_directory_path() / fmt::format("nacre-dashboard-{}", ::getpid());
  FakeDesk desk_;
  std::optional<Dashboard> dashboard_;
  std::optional<SeveralRuns> page_;  ///< reads its files when it is made
};

TEST_F(DashboardOfARun, EveryReadingIsAnswered) {
  for (const char* path :
       {"/api/run", "/api/live", "/api/rounds", "/api/laboratory", "/api/next", "/api/maps", "/api/families"}) {
    const Response response = get(path);
    EXPECT_EQ(response.status, 200) << path << response.body;
    EXPECT_TRUE(Json::accept(response.body)) << path;
  }
  EXPECT_EQ(get("/api/design", {{"design", "577fffe9fffdef"}}).status, 200);
  EXPECT_EQ(get("/api/diagnosis", {{"round", "1"}}).status, 200);
}

TEST_F(DashboardOfARun, AMisfitOfTheCalibrationStandsBesideAVerdictThatFindsNothing) {
  EXPECT_EQ(json("/api/diagnosis", {{"round", "1"}})["against"], "");
  wire::AdoptedModel model = wire::samples::model();
  model.round = 1;
  model.provenance.modulus_fit.p_value = 1e-9;
  wire::Diagnosis nothing = wire::samples::diagnosis();
  nothing.verdict = "base_sufficient";
  run::RunDatabase database(folder_ / "run.db");
  database.keep("PARAMETERS", wire::write(model));
  database.keep("DIAGNOSIS", wire::write(nothing));
  EXPECT_THAT(json("/api/diagnosis", {{"round", "1"}})["against"].get<std::string>(), HasSubstr("does not explain E"));
}

TEST_F(DashboardOfARun, AGamutIsColumnsThatABrowserReadsInPlace) {
  const std::string bytes = get("/api/gamut", {{"round", "7"}}).body;
  ASSERT_EQ(bytes.substr(0, 8), "NACREGMT");
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, sizeof(length));
  EXPECT_EQ((16 + length) % 8, 0u);
  const Json header = Json::parse(bytes.substr(16, length));
  EXPECT_EQ(header["count"], 30);
  EXPECT_EQ(bytes.size(), 16 + length + 30 * 16u);
  EXPECT_FALSE(header["front"].empty());
  EXPECT_EQ(json("/api/rounds")["rounds"].back()["gamut_count"], 30);
}

TEST_F(DashboardOfARun, WhatTheAnalyserWritesIsSeen) {
  const std::string before = json("/api/live")["data"];
  run::RunDatabase database(folder_ / "run.db");
  wire::GamutChunk chunk = gamut_chunk(0);
  chunk.round = 8;
  database.keep("GAMUT", wire::write(chunk));
  EXPECT_NE(json("/api/live")["data"], before);
  EXPECT_EQ(json("/api/rounds")["rounds"].back()["round"], 8);
}

TEST_F(DashboardOfARun, WritesWithinATickOfTheClockAreToldApart) {
  run::RunDatabase database(folder_ / "run.db");
  wire::GamutChunk chunk = gamut_chunk(0);
  std::set<std::string> versions;
  for (chunk.round = 8; chunk.round < 108; ++chunk.round) {
    database.keep("GAMUT", wire::write(chunk));
    versions.insert(json("/api/live")["data"]);
  }
  EXPECT_EQ(versions.size(), 100);
}

TEST_F(DashboardOfARun, NodesOfARunThatIsOverAreNotCalledSilent) {
  wire::NodeStatus finished;
  finished.finished = true;
  desk_.reports = {{"analyser", finished, 20.0}, {"simulator_farm", wire::NodeStatus{}, 20.0}};
  const auto states = [&] {
    std::vector<std::string> found;
    const Json live = json("/api/live");
    for (const Json& node : live["nodes"]) found.push_back(node["state"]);
    return found;
  };
  EXPECT_EQ(states(), (std::vector<std::string>{"finished", "silent"}));
  run::RunDatabase database(folder_ / "run.db");
  wire::RoundSummary last = wire::samples::round();
  last.last = true;
  database.keep("ROUND", wire::write(last));
  EXPECT_EQ(states(), (std::vector<std::string>{"finished", "ended"}));
}

TEST_F(DashboardOfARun, AnAddressThatCannotBeListenedToIsSaidWithItsCause) {
  const auto nobody = [](const Request&) { return Response{}; };
  const auto complaint = [&](const std::string& host, int port) -> std::string {
    try {
      serve(
          nobody, {.host = host, .port = port, .token = ""}, [](int) {}, [] { return true; });
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(complaint("300.1.1.1", 0), HasSubstr("300.1.1.1:0: is no address: "));
  EXPECT_THAT(complaint("192.0.2.1", 0), HasSubstr("is no address of this machine"));  // TEST-NET-1 is nobody's
  std::string second;
  int asked = 0;
  serve(
      nobody, {.host = "127.0.0.1", .port = 0, .token = ""}, [&](int port) { second = complaint("127.0.0.1", port); },
      [&] { return ++asked > 1; });
  EXPECT_THAT(second, HasSubstr("is another dashboard there?"));
}

TEST_F(DashboardOfARun, NoFileOutsideThePageIsServed) {
  for (const char* path : {"/secret.toml", "/../secret.toml", "/page/../secret.toml", "//secret.toml",
                           "/index.html/../../secret.toml", "/run.db", "/%2e%2e/secret.toml"})
    EXPECT_EQ(get(path).status, 404) << path;
  EXPECT_EQ(get("/").body, "<p>page</p>");
  for (const char* id : {"../films", "a/../../secret", "family-1", "/", "family-1/577fffe9fffdef", ""})
    EXPECT_EQ(get("/api/map", {{"id", id}}).status, 404) << id;
}

TEST_F(DashboardOfARun, NumbersAndNamesOutOfRangeAreRefused) {
  for (const char* round : {"", "-1", "1e3", "x", "99999999999", "1 ", "0x1"})
    EXPECT_EQ(get("/api/gamut", {{"round", round}}).status, 400) << round;
  EXPECT_EQ(json("/api/gamut", {{"round", "1e3"}})["error"], "round: `1e3`, expected a whole number from 0 to 1000000");
  EXPECT_EQ(get("/api/gamut").status, 400);
  EXPECT_EQ(get("/api/gamut", {{"round", "99"}}).status, 404);
  for (const char* design : {"", "577fffe9fffde", "../x", "mix:2", "mix:nan"})
    EXPECT_EQ(get("/api/design", {{"design", design}}).status, 400) << design;
  for (const char* model : {"", "..", "a/b", "a b"})
    EXPECT_EQ(get("/api/film", {{"design", "soft"}, {"model", model}}).status, 400) << model;
  EXPECT_EQ(get("/api/between", {{"patterns", "577fffe9fffdef,577fffe9fffdef"}, {"weights", "0.5"}}).status, 400);
  EXPECT_EQ(get("/api/between", {{"patterns", "577fffe9fffdef"}, {"weights", "0"}}).status, 400);
  EXPECT_EQ(get("/api/between", {{"patterns", "577fffe9fffdef"}, {"weights", "-inf"}}).status, 400);
}

TEST_F(DashboardOfARun, BetweenAPatternAndItselfLiesThePattern) {
  const Json found =
      json("/api/between", {{"patterns", "577fffe9fffdef,577fffe9fffdef,3ffc9b4ad4d2d9"}, {"weights", "0.3,0.7,0"}});
  EXPECT_EQ(found["pattern"], "577fffe9fffdef");
}

TEST_F(DashboardOfARun, AReviewThatTheGameWouldNotHeedIsRefusedWithTheReason) {
  desk_.reason_against = "a: cannot be valid: modulus_pa 1.2 Pa";
  const Response refusal = post("/api/review", R"({"specimen":"a","valid":true,"by":"Ada","why":"looks fine"})");
  EXPECT_EQ(refusal.status, 409);
  EXPECT_THAT(refusal.body, HasSubstr("cannot be valid"));
  EXPECT_TRUE(desk_.reviews.empty());
}

TEST_F(DashboardOfARun, WhatIsEnteredReachesTheDesk) {
  EXPECT_EQ(post("/api/review", R"({"specimen":"a","valid":false,"by":"Ada","why":"slipped"})").status, 200);
  EXPECT_EQ(desk_.reviews.at(0).why, "slipped");
  EXPECT_EQ(
      post("/api/approval", R"({"design":"577fffe9fffdef","round":0,"approved":true,"by":"Ada","why":""})").status,
      200);
  EXPECT_EQ(desk_.approvals.at(0).design, "577fffe9fffdef");
  EXPECT_EQ(post("/api/measurement", R"({"specimen":"a","pattern":"soft","test":"modulus","modulus_pa":1e6})").status,
            200);
  EXPECT_EQ(desk_.specimens.at(0).modulus_pa, 1e6);
  EXPECT_EQ(post("/api/amendment", R"({"specimen":"a","by":"Ada","why":"typed twice","modulus_pa":2e6})").status, 200);
  EXPECT_EQ(desk_.amendments.at(0).changes, (std::map<std::string, std::string>{{"modulus_pa", "2000000"}}));
  EXPECT_EQ(desk_.specimens.at(1).specimen, "a");
  EXPECT_EQ(post("/api/withdrawal", R"({"order":"r1/soft/modulus","withdrawn":true,"by":"Ada","why":"resin"})").status,
            200);
  EXPECT_EQ(desk_.withdrawals.at(0).order, "r1/soft/modulus");
  desk_.reason_against = "order r1/soft/modulus is complete";
  EXPECT_EQ(post("/api/withdrawal", R"({"design":"soft","withdrawn":false,"by":"Ada"})").status, 409);
  EXPECT_EQ(post("/api/amendment", R"({"specimen":"a","by":"Ada","why":"typo","thickness_mm":-1})").status, 400);
  EXPECT_EQ(desk_.withdrawals.size(), 1u);
  EXPECT_EQ(desk_.specimens.size(), 2u);
}

TEST_F(DashboardOfARun, AnAmendedSpecimenShowsWhatItWas) {
  Laboratory laboratory;
  measurement::SpecimenRecord record;
  record.specimen = "s";
  record.design = pattern::Design(pattern::Pattern(7));
  record.modulus_pa = 1e8;
  laboratory.facts.book.enter(record, "");
  record.modulus_pa = 1e9;
  laboratory.facts.book.enter(record, "", {1, "Ada", "decimal point"});
  desk_.picture = std::make_shared<const Laboratory>(std::move(laboratory));
  const Json specimen = json("/api/laboratory")["specimens"].at(0);
  EXPECT_EQ(specimen["modulus_pa"], 1e9);
  EXPECT_EQ(specimen["amended_why"], "decimal point");
  ASSERT_EQ(specimen["earlier"].size(), 1u);
  EXPECT_EQ(specimen["earlier"][0]["modulus_pa"], 1e8);
}

TEST_F(DashboardOfARun, WhatTheGameDoesNotTakeIsSaid) {
  desk_.answer = {Delivery::unanswered};
  const Response late = post("/api/review", R"({"specimen":"a","valid":false,"by":"Ada","why":"slipped"})");
  EXPECT_EQ(late.status, 504);
  EXPECT_THAT(late.body, HasSubstr("is the game still running"));
  desk_.answer = {Delivery::conflicting};
  EXPECT_EQ(post("/api/measurement", R"({"specimen":"a","pattern":"soft","test":"modulus","modulus_pa":1e6})").status,
            409);
  EXPECT_EQ(post("/api/measurement", "{").status, 400);
  EXPECT_EQ(desk_.specimens.size(), 1u);
}

TEST_F(DashboardOfARun, ALateRefusalComesWithItsReason) {
  desk_.answer = {Delivery::refused, "soft is ordered already. What the run has stays."};
  for (const auto& [path, body] : std::map<std::string, std::string>{
           {"/api/approval", R"({"design":"soft","approved":true,"by":"Ada","why":""})"},
           {"/api/measurement", R"({"specimen":"a","pattern":"soft","test":"modulus","modulus_pa":1e6})"},
           {"/api/review", R"({"specimen":"a","valid":false,"by":"Ada","why":"slipped"})"}}) {
    const Response refusal = post(path, body);
    EXPECT_EQ(refusal.status, 409) << path;
    EXPECT_EQ(Json::parse(refusal.body)["answer"], "refused");
    EXPECT_EQ(Json::parse(refusal.body)["error"], desk_.answer.refusal);
  }
}

TEST_F(DashboardOfARun, TheLaboratoryIsWrittenAnewOnlyWhenItHasChanged) {
  const auto with_specimens = [](int count) {
    Laboratory laboratory;
    for (int i = 0; i < count; ++i) {
      measurement::SpecimenRecord record;
      record.specimen = fmt::format("s{}", i);
      record.design = pattern::Design(pattern::Pattern(7));
      laboratory.facts.book.enter(record, "");
    }
    return std::make_shared<const Laboratory>(std::move(laboratory));
  };
  desk_.picture = with_specimens(2);
  EXPECT_EQ(json("/api/laboratory")["specimens"].size(), 2u);
  desk_.picture = with_specimens(3);
  for (int turn = 0; turn < 100 && json("/api/laboratory")["specimens"].size() != 3u; ++turn) ::usleep(20'000);
  EXPECT_EQ(json("/api/laboratory")["specimens"].size(), 3u);
}

TEST_F(DashboardOfARun, EveryAddressMayNameItsRun) {
  for (const char* path : {"/api/run", "/api/rounds", "/api/live", "/api/laboratory", "/api/families"})
    EXPECT_EQ(get(std::string("/runs/game") + path).body, get(path).body) << path;
  EXPECT_EQ(get("/runs/game/api/gamut", {{"round", "7"}}).body, get("/api/gamut", {{"round", "7"}}).body);
  EXPECT_EQ(get("/runs/game/api/nothing").status, 404);
  EXPECT_EQ(get("/runs/game").status, 404);
  EXPECT_EQ(post("/runs/game/api/run", "{}").status, 405);
  EXPECT_EQ(post("/runs/game/api/review", R"({"specimen":"a","valid":false,"by":"Ada","why":"slipped"})").status, 200);
  EXPECT_EQ(desk_.reviews.size(), 1u);
}

TEST_F(DashboardOfARun, ANameThatIsNoRunsIsRefused) {
  for (const char* name : {"", "..", ".", "gam", "game2", "..%2f..", "../game", "Game"})
    for (const char* path : {"/api/run", "/report", "/../secret.toml"})
      EXPECT_EQ(get(fmt::format("/runs/{}{}", name, path)).status, 404) << name << path;
  EXPECT_EQ(get("/runs/game/../secret.toml").status, 404);
  EXPECT_EQ(json("/runs/other/api/run")["error"], "there is no run `other` here, expected broken, game");
  EXPECT_EQ(get("/runs/broken/api/run").status, 503);
  EXPECT_EQ(json("/runs/broken/api/run")["error"], "run.db: is no database");
}

TEST_F(DashboardOfARun, TheListTellsHowFarEachRunIsAndWhyOneCannotBeRead) {
  run::RunDatabase database(folder_ / "run.db");
  wire::RoundSummary closed = wire::samples::round();
  closed.round = 7;
  closed.measured_hypervolume_staircase = 1.5;
  database.keep("ROUND", wire::write(closed));
  const Json before = json("/api/runs")["runs"];
  ASSERT_EQ(before.size(), 2u);
  EXPECT_EQ(before[0]["run"], "broken");
  EXPECT_EQ(before[0]["state"], "unreadable");
  EXPECT_EQ(before[0]["problem"], "run.db: is no database");
  EXPECT_TRUE(before[0]["round"].is_null());
  EXPECT_EQ(before[1]["run"], "game");
  EXPECT_EQ(before[1]["state"], "stopped");
  EXPECT_EQ(before[1]["round"], 7);
  EXPECT_EQ(before[1]["measured_hypervolume"], 1.5);
  EXPECT_EQ(before[1]["gap"], closed.gap);
  desk_.reports = {{"analyser", wire::NodeStatus{}, 1.0}};
  EXPECT_EQ(json("/api/runs")["runs"][1]["state"], "playing");
  wire::RoundSummary last = closed;
  last.round = 8;
  last.last = true;
  last.measured_hypervolume_staircase = 0.0;
  database.keep("ROUND", wire::write(last));
  const Json after = json("/api/runs")["runs"][1];
  EXPECT_EQ(after["state"], "finished");
  EXPECT_NE(after["data"], before[1]["data"]);
  EXPECT_TRUE(after["gap"].is_null()) << "nothing is measured";
}

TEST_F(DashboardOfARun, ARunThatCannotBeReadAnyMoreIsARowThatSaysSo) {
  EXPECT_EQ(json("/api/runs")["runs"][1]["state"], "stopped");
  std::ofstream(folder_ / "run.db") << std::string(4096, 'x');
  const Json row = json("/api/runs")["runs"][1];
  EXPECT_EQ(row["state"], "unreadable") << row;
  EXPECT_THAT(row["problem"].get<std::string>(), HasSubstr("run.db"));
}

TEST_F(DashboardOfARun, ReadingsAreReadAndEntriesArePosted) {
  EXPECT_EQ(post("/api/run", "{}").status, 405);
  EXPECT_EQ(get("/api/review").status, 405);
  EXPECT_EQ(post("/", "{}").status, 404);
}

TEST_F(DashboardOfARun, AFilmThatIsNotThereIsMadeOnDemand) {
  const std::map<std::string, std::string> query = {{"design", "577fffe9fffdef"}, {"model", "2"}};
  EXPECT_EQ(json("/api/simulation", query)["state"], "absent");
  EXPECT_EQ(get("/api/film", query).status, 404);
  EXPECT_EQ(post("/api/simulate", R"({"design":"577fffe9fffdef","model":"3"})").status, 409);  // no such model
  ASSERT_EQ(post("/api/simulate", R"({"design":"577fffe9fffdef","model":"2"})").status, 202);
  Json state;
  for (int turn = 0; turn < 1200 && (state = json("/api/simulation", query))["state"] != "ready"; ++turn)
    ::usleep(50'000);
  ASSERT_EQ(state["state"], "ready") << state.dump();
  EXPECT_GT(state["modulus_pa"].get<double>(), 0.0);
  EXPECT_EQ(get("/api/film", query).body.substr(0, 8), "NACREFLM");
}

TEST_F(DashboardOfARun, FamiliesOfTheStageComeWithTheErrorsOfBothModels) {
  const Json said = json("/api/families");
  ASSERT_EQ(said["stage"].size(), 1u) << said.dump();
  const Json& family = said["stage"][0];
  EXPECT_EQ(family["name"], "family-2");
  EXPECT_EQ(family["is_validated"], true);
  EXPECT_EQ(family["designs"].size(), 2u);
  EXPECT_TRUE(family["designs"][1]["measured"]["toughness_pa"].is_null());
  // The sample's seed: E 1.5 GPa measured, 1.6 by the global model, 1.5 by the family's; the chosen one: 1.4, 1.3, 1.2.
  const Json& errors = family["errors"];
  EXPECT_NEAR(errors["seeds"]["global"]["modulus_mean"].get<double>(), 0.1 / 1.5, 1e-9);
  EXPECT_NEAR(errors["seeds"]["family"]["modulus_mean"].get<double>(), 0.0, 1e-9);
  EXPECT_NEAR(errors["chosen"]["family"]["modulus_mean"].get<double>(), 0.2 / 1.4, 1e-9);
  EXPECT_EQ(family["over_fits"], Json::array({"E"}));
}

TEST_F(DashboardOfARun, TheVariantsOfAFamilyAreColumnsLikeAGamut) {
  run::RunDatabase database(folder_ / "run.db");
  wire::FamilyGamut chunk = wire::samples::family_gamut();
  chunk.number = wire::samples::family().number;
  database.keep("FAMILY_GAMUT", wire::write(chunk));
  EXPECT_EQ(get("/api/gamut", {{"family", "family-2"}}).body.substr(0, 8), "NACREGMT");
  EXPECT_EQ(json("/api/families")["stage"][0]["gamut_count"], 1);
  EXPECT_EQ(get("/api/gamut", {{"family", "family-9"}}).status, 404);
}

TEST_F(DashboardOfARun, AFilmOfAFamilysDesignComesFromTheGame) {
  const std::string design = film_of_the_stage();
  const std::map<std::string, std::string> query = {{"design", design}, {"model", "family-2"}};
  EXPECT_EQ(json("/api/simulation", query)["source"], "run");
  EXPECT_EQ(get("/api/film", query).body, "NACREFLM of the game");
  EXPECT_EQ(json("/api/simulation", {{"design", design}, {"model", "family-3"}})["state"], "absent");
}

TEST_F(DashboardOfARun, AFilmOfTheGameIsNoneOfARegroupedFamilyOfItsName) {
  const std::map<std::string, std::string> on_stage = {{"design", film_of_the_stage()}, {"model", "family-2"}};
  std::map<std::string, std::string> on_map = on_stage;
  on_map["map"] = "family-2/577fffe9fffdef";
  keep_model_in_folder(2.0);
  EXPECT_EQ(json("/api/simulation", on_map)["state"], "absent");
  EXPECT_EQ(get("/api/film", on_map).status, 404);
  EXPECT_EQ(json("/api/simulation", on_stage)["source"], "run");
  keep_model_in_folder(1.0);  // what `nacre families` took from the stage
  EXPECT_EQ(json("/api/simulation", on_map)["source"], "run");
  EXPECT_EQ(get("/api/film", on_map).body, "NACREFLM of the game");
}

TEST_F(DashboardOfARun, AFilmMadeHereIsKnownByTheParametersThatBrokeIt) {
  const std::map<std::string, std::string> map = {{"map", "family-2/577fffe9fffdef"}},
                                           on_stage = {{"design", "577fffe9fffdef"}, {"model", "family-2"}};
  std::map<std::string, std::string> on_map = on_stage;
  on_map.insert(map.begin(), map.end());
  keep_model_in_folder(2.0);
  ASSERT_EQ(post("/api/simulate", R"({"design":"577fffe9fffdef","model":"family-2"})", map).status, 202);
  EXPECT_NE(json("/api/simulation", on_map)["state"], "absent");
  EXPECT_EQ(json("/api/simulation", on_stage)["state"], "absent") << "the game has another model of this name";
  keep_model_in_folder(3.0);  // `nacre families` once more
  EXPECT_EQ(json("/api/simulation", on_map)["state"], "absent");
}

TEST_F(DashboardOfARun, AModelThatTheGameHasNotCannotBeSimulatedWith) {
  EXPECT_EQ(post("/api/simulate", R"({"design":"577fffe9fffdef","model":"family-9"})").status, 409);
  EXPECT_EQ(post("/api/simulate", R"({"design":"577fffe9fffdef","model":"99"})").status, 409);
}

TEST_F(DashboardOfARun, APatternThatIsDrawnHasItsModulusAndItsViolationsAtOnce) {
  const Json published = json("/api/check", {{"design", "577fffe9fffdef"}, {"model", "start"}});
  EXPECT_EQ(published["violations"], Json::array());
  EXPECT_EQ(published["soft_corner"], "00000000000000");
  EXPECT_NEAR(published["modulus_pa"].get<double>(), 1.2e9, 0.6e9);
  const Json soft = json("/api/check", {{"design", "00000000000000"}, {"model", "start"}});
  ASSERT_EQ(soft["violations"].size(), 2u);
  EXPECT_THAT(soft["violations"][0].get<std::string>(), HasSubstr("fewer than the 50 %"));
  EXPECT_EQ(soft["violations"][1], "the corner pixel is soft, it must be rigid");
  EXPECT_EQ(soft["soft_corner"], "00000000000001");
  EXPECT_LT(soft["modulus_pa"].get<double>(), 0.01 * published["modulus_pa"].get<double>());
  const Json skewed = json("/api/check", {{"design", "L8" + std::string(99, '0')}, {"model", "start"}});
  EXPECT_THAT(skewed["violations"][0].get<std::string>(), HasSubstr("lacks the eightfold symmetry"));
  EXPECT_EQ(get("/api/check", {{"design", "soft"}, {"model", "99"}}).status, 409);
  EXPECT_EQ(get("/api/check", {{"design", "soft"}}).status, 400);
}

TEST_F(DashboardOfARun, MechanismsComeOfCracksThatFitTheSpecimens) {
  EXPECT_EQ(json("/api/mechanisms")["designs"], Json::array());
  tester::Simulation simulation{pattern::design_from_name("577fffe9fffdef").value(),
                                wire::samples::family().parameters,
                                {},
                                tester::Fidelity::tiny};
  const auto result = tester::test_toughness(simulation);
  ASSERT_TRUE(result) << result.error().message;
  wire::Fracture fracture = wire::samples::fracture();
  fracture.design = simulation.design;
  fracture.crack = crack::record_of(simulation, result->breaks);
  fracture.broken = static_cast<int>(result->breaks.size());
  fracture.request_id = fmt::format("analyser/family{}/films", wire::samples::family().number);
  run::RunDatabase(folder_ / "run.db").keep("FRACTURE", wire::write(fracture));
  const Json designs = json("/api/mechanisms")["designs"];
  ASSERT_EQ(designs.size(), 1u);
  EXPECT_EQ(designs[0]["design"], "577fffe9fffdef");
  EXPECT_EQ(designs[0]["model"], "family-2");
  const auto mechanisms = crack::mechanisms_of(simulation, fracture.crack);
  EXPECT_EQ(designs[0]["deflection"], mechanisms.deflection);
  EXPECT_EQ(designs[0]["branching"], mechanisms.branching);
}

TEST_F(DashboardOfARun, ASpecimensStoryHoldsWhatCameAndEveryReview) {
  wire::Measurement measured = wire::samples::measurement();
  measured.record.specimen = "told";
  run::RunDatabase database(folder_ / "run.db");
  database.keep("MEASUREMENT", wire::write(measured));
  for (const int revision : {2, 1}) {
    wire::Review review;
    review.specimen = "told";
    review.revision = revision;
    review.valid = revision == 2;
    review.by = "Ada";
    review.why = fmt::format("look {}", revision);
    database.keep("REVIEW", wire::write(review));
  }
  const Json story = json("/api/specimen", {{"specimen", "told"}});
  ASSERT_EQ(story["measurements"].size(), 1u);
  EXPECT_EQ(story["measurements"][0]["points"], measured.record.curve.size());
  ASSERT_EQ(story["reviews"].size(), 2u);
  EXPECT_EQ(story["reviews"][0]["why"], "look 1");
  EXPECT_EQ(story["reviews"][1]["valid"], true);
  EXPECT_EQ(json("/api/specimen", {{"specimen", "nobody"}})["measurements"], Json::array());
}

TEST_F(DashboardOfARun, APersonGroupsMeasuredDesigns) {
  run::RunDatabase database(folder_ / "run.db");
  wire::Measurement m = wire::samples::measurement();
  m.round = 0;
  m.record.design = pattern::Pattern(0x577fffe9fffdef);
  m.record.curve = {};
  for (const bool is_modulus : {true, false}) {
    m.record.specimen = is_modulus ? "E" : "T";
    m.record.test = is_modulus ? tester::TestKind::modulus : tester::TestKind::toughness;
    m.record.modulus_pa = is_modulus ? std::optional(1e9) : std::nullopt;
    m.record.toughness_pa = is_modulus ? std::nullopt : std::optional(4e5);
    database.keep("MEASUREMENT", wire::write(m));
  }
  const Json proposed = json("/api/families")["grouping"];
  EXPECT_EQ(proposed["from"], "proposal");
  EXPECT_EQ(proposed["near_pareto"], Json::array({"577fffe9fffdef"}));
  ASSERT_EQ(proposed["families"].size(), 1u);

  EXPECT_EQ(post("/api/grouping", R"({"families":[{"name":"mine","seeds":["577fffe9fffdef"]}]})").status, 200);
  EXPECT_EQ(desk_.groupings.at(0), (std::vector<families::SeedFamily>{{"mine", {pattern::Pattern(0x577fffe9fffdef)}}}));
  const Response unmeasured = post("/api/grouping", R"({"families":[{"name":"mine","seeds":["3ffc9b4ad4d2d9"]}]})");
  EXPECT_EQ(unmeasured.status, 400);
  EXPECT_THAT(unmeasured.body, HasSubstr("not measured"));
  EXPECT_EQ(desk_.groupings.size(), 1u);

  fs::create_directories(folder_ / "families");
  std::ofstream(folder_ / "families" / "families.toml") << families::to_toml(desk_.groupings[0]);
  EXPECT_EQ(json("/api/families")["grouping"]["from"], "file");
  EXPECT_EQ(json("/api/families")["grouping"]["families"][0]["name"], "mine");
  std::ofstream(folder_ / "families" / "families.toml") << "[[family]]\nname = 3\n";
  EXPECT_THAT(json("/api/families")["grouping"]["problem"].get<std::string>(), HasSubstr("families.toml:1"));
}

TEST_F(DashboardOfARun, TheMapOfAGamutIsMadeOnDemand) {
  Json state;
  for (int turn = 0; turn < 400 && (state = json("/api/map", {{"id", "gamut/7"}}))["state"] != "ready"; ++turn)
    ::usleep(50'000);
  ASSERT_EQ(state["state"], "ready") << state.dump();
  EXPECT_EQ(state["map"]["pattern"].size(), 30u);
  EXPECT_FALSE(state["map"]["triangles"].empty());
  EXPECT_EQ(get("/api/map", {{"id", "gamut/x"}}).status, 400);
}

wire::SimulateResult searched(const std::string& request, std::vector<std::uint64_t> patterns) {
  wire::SimulateResult result{.request_id = request, .chunk = 0, .chunks = 1, .first = 0, .results = {}};
  for (const std::uint64_t bits : patterns) {
    wire::SimulatedDesign simulated;
    simulated.design = pattern::Pattern(bits);
    simulated.modulus_pa = 1e9;
    simulated.toughness_pa = 5e5;
    result.results.push_back(simulated);
  }
  return result;
}

TEST_F(DashboardOfARun, AGamutFillsWhileItIsSearched) {
  const std::string before = json("/api/live").at("data");
  desk_.live.take(searched("proposal_agent/r8/s1/g1#0123", {5, 6}));
  EXPECT_NE(json("/api/live").at("data"), before);
  EXPECT_EQ(json("/api/rounds").at("rounds").back().at("gamut_count"), 2);
  const std::string gamut = get("/api/gamut", {{"round", "8"}}).body;
  EXPECT_THAT(gamut, HasSubstr(R"("round":8,"count":2)"));
}

TEST_F(DashboardOfARun, APublishedGamutStaysAsItIs) {
  desk_.live.take(searched("proposal_agent/r7/s1/g1", {5, 6}));
  EXPECT_THAT(get("/api/gamut", {{"round", "7"}}).body, HasSubstr(R"("round":7,"count":30)"));
}

TEST_F(DashboardOfARun, BaseMaterialsBreakBeforeThereIsAModel) {
  const Response asked = post("/api/simulate", R"({"design": "rigid", "model": "start"})");
  EXPECT_EQ(asked.status, 202) << asked.body;
}

TEST(LiveSearch, TakesEachPatternOnceAndOfTheNewestSearchAlone) {
  LiveSearch search;
  search.take(searched("proposal_agent/r1/s1/g1", {5, 6}));
  search.take(searched("proposal_agent/r1/s1/g1", {6, 5}));
  search.take(searched("proposal_agent/r1/redraw1/d0", {7}));
  search.take(searched("analyser/r1/measured/0", {8}));
  EXPECT_EQ(search.gamut(1).patterns, (std::vector<std::uint64_t>{5, 6}));
  search.take(searched("proposal_agent/r2/s1/g1", {9}));
  search.take(searched("proposal_agent/r1/s2/g1", {10}));
  EXPECT_EQ(search.progress()->round, 2);
  EXPECT_EQ(search.gamut(2).patterns, (std::vector<std::uint64_t>{9}));
  EXPECT_TRUE(search.gamut(1).patterns.empty());
}

TEST(LiveSearch, LeavesDesignsWithoutANumberOut) {
  LiveSearch search;
  wire::SimulateResult result = searched("proposal_agent/r1/s1/g1", {5, 6});
  result.results.front().failure = "no force";
  search.take(result);
  EXPECT_EQ(search.gamut(1).patterns, (std::vector<std::uint64_t>{6}));
}

}  // namespace
}  // namespace nacre::dashboard
