// What a person with a printer and a testing machine types: print files, imports, reviews, states of designs.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/files.hpp"
#include "measurement/read_set.hpp"
#include "measurement/summary.hpp"
#include "measurement/write_set.hpp"
#include "persons_game.hpp"
#include "program.hpp"
#include "run/run.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const fs::path kExports = fs::path(NACRE_SOURCE_DIR) / "tests/unit/measurement/data/exports";
const fs::path kExample = fs::path(NACRE_SOURCE_DIR) / "data/examples/tester";

TEST(Fabricate, WritesTheSlicesOfOneModelAndItsBuildSheet) {
  const fs::path folder = fresh_folder("fabricate");
  const Outcome outcome = run_nacre({"fabricate", "577fffe9fffdef", "--out", folder.string(), "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto sheet = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(sheet["models"][0]["slice_count"], 101);
  EXPECT_EQ(sheet["models"][0]["columns"], 614);
  EXPECT_EQ(sheet["models"][0]["rows"], 2457);
  EXPECT_EQ(sheet["specimens"].size(), 4U);
  for (const char* file : {"slices/0000.png", "slices/0100.png", "preview.png", "build_sheet.html", "specimens.csv"})
    EXPECT_TRUE(fs::exists(folder / file)) << file;
  EXPECT_FALSE(fs::exists(folder / "slices/0101.png"));
}

TEST(Fabricate, RefusesWhatCannotBePrinted) {
  const std::string folder = fresh_folder("refused").string();
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"fabricate", "--out", folder},
        {"fabricate", "mix:1.5", "--out", folder},
        {"fabricate", "rigid", "--dpi", "1,1,1", "--out", folder},
        {"fabricate", "checkerboard:3", "--out", folder},
        {"fabricate", "rigid", "--tray-mm", "50,50", "--out", folder},
        {"fabricate", "checkerboard:5", "--test", "tensile", "--out", folder},
        {"fabricate", "rigid", "--loading", "strain 0.02 0.005", "--out", folder},
        {"fabricate", "rigid", "--test", "tensile", "--loading", "up", "--out", folder}}) {
    EXPECT_EQ(run_nacre(wrong).status, 2) << wrong[1];
  }
}

// What a diagnosis asks for next, without a game.
TEST(Fabricate, ACouponsSheetSaysHowItIsToBePulled) {
  const fs::path folder = fresh_folder("tensile");
  const Outcome outcome =
      run_nacre({"fabricate", "rigid", "--test", "tensile", "--loading", "strain 0.02 0.005 0.022",
                 "--strain-rate-per-s", "0.00617", "--dpi", "100,100,100", "--out", folder.string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string sheet = read_file(folder / "specimens.csv");
  EXPECT_THAT(sheet, HasSubstr(",rigid,tensile,"));
  EXPECT_THAT(sheet, HasSubstr(",0.00617,\"to 2 % strain, back to 0.5 %, on to 2.2 %\","));
}

TEST(Fabricate, WritesOverAnotherJobOnlyWhenToldTo) {
  const fs::path folder = fresh_folder("known_job");
  const auto fabricate = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"fabricate", "--dpi", "100,100,100", "--out", folder.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_nacre(arguments);
  };
  ASSERT_EQ(fabricate({"rigid"}).status, 0);
  const std::string sheet = read_file(folder / "build_sheet.json");
  std::ofstream(folder / "specimens.csv") << "filled in\n";
  const Outcome refused = fabricate({"soft"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("expected a new folder, or --replace"));
  EXPECT_EQ(read_file(folder / "build_sheet.json"), sheet);
  EXPECT_EQ(read_file(folder / "specimens.csv"), "filled in\n");
  EXPECT_EQ(fabricate({"rigid"}).status, 0) << "the same job";
  EXPECT_EQ(read_file(folder / "specimens.csv"), "filled in\n");
  EXPECT_EQ(fabricate({"soft", "--replace"}).status, 0);
  EXPECT_THAT(read_file(folder / "specimens.csv"), HasSubstr(",soft,"));
}

TEST(ImportProgram, MakesASetOfWhatIsUsableAndNamesTheRest) {
  const fs::path set = fresh_folder("imported") / "set";
  const Outcome outcome = run_nacre(
      {"import", "--specimens", (kExports / "damaged/specimens.csv").string(), "--out", set.string(), "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["specimens"].size(), 2U);
  EXPECT_EQ(report["rejected"].size(), 22U);
  for (const auto& fault : report["rejected"]) EXPECT_THAT(fault["reason"].get<std::string>(), Not(IsEmpty()));
  EXPECT_EQ(std::ranges::count(report["rejected"], "", [](const auto& fault) { return fault["specimen"]; }), 0);
  EXPECT_EQ(measurement::read_measurement_set(set).specimens.size(), 2U);
}

TEST(ImportProgram, KeepsWhatAPreviewShowsOnlyWhenToldTo) {
  const fs::path folder = fresh_folder("previewed");
  const std::string page = (folder / "page.html").string(), set = (folder / "set").string();
  const std::vector<std::string> arguments = {
      "import", "--specimens", (kExample / "specimens.csv").string(), "--preview", page, "--out", set};
  const Outcome shown = run_nacre(arguments);
  ASSERT_EQ(shown.status, 0) << shown.err;
  EXPECT_THAT(shown.err, HasSubstr("no set is written; the same with --out SET --yes keeps it"));
  EXPECT_THAT(read_file(page), HasSubstr("tutorial-01"));
  EXPECT_FALSE(fs::exists(set));
  std::vector<std::string> approved = arguments;
  approved.emplace_back("--yes");
  ASSERT_EQ(run_nacre(approved).status, 0);
  EXPECT_FALSE(measurement::read_measurement_set(set).specimens.empty());
}

TEST(ImportProgram, EndsWithStatusTwoWhenNothingIsUsable) {
  const fs::path folder = fresh_folder("unusable");
  std::ofstream(folder / "sheet.csv")
      << "file,specimen,pattern,width_mm,thickness_mm,gauge_mm\nx.csv,A,rigid,52,3.2,54\n";
  std::ofstream(folder / "x.csv") << "no numbers here\n";
  const Outcome outcome = run_nacre({"import", (folder / "x.csv").string(), "--specimens",
                                     (folder / "sheet.csv").string(), "--out", (folder / "set").string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("none of its specimens is usable"));
  EXPECT_FALSE(fs::exists(folder / "set"));
}

TEST(ReviewProgram, ProposesTheOutlierOfTheExampleAndLeavesTheDecisionToAPerson) {
  const std::string set = (fresh_folder("example") / "set").string();
  const Outcome imported = run_nacre({"import", "--specimens", (kExample / "specimens.csv").string(), "--out", set});
  ASSERT_EQ(imported.status, 0) << imported.err;
  const auto shown = nlohmann::json::parse(run_nacre({"review", "--set", set, "--json"}).out);
  EXPECT_EQ(shown["groups"].size(), 8U);
  std::set<std::string> proposed;
  for (const auto& group : shown["groups"]) {
    for (const auto& outlier : group["proposed_outliers"]) proposed.insert(outlier["specimen"].get<std::string>());
    EXPECT_EQ(group["state"], "complete") << group;
  }
  EXPECT_EQ(proposed, std::set<std::string>{"tutorial-19"});
  for (const auto& specimen : measurement::read_measurement_set(set).specimens) EXPECT_TRUE(specimen.valid);

  ASSERT_EQ(run_nacre({"review", "--set", set, "tutorial-19", "--invalid", "--why", "bubble", "--by", "me"}).status, 0);
  for (const auto& specimen : measurement::read_measurement_set(set).specimens) {
    EXPECT_EQ(specimen.valid, specimen.specimen != "tutorial-19");
    EXPECT_EQ(specimen.note, specimen.valid ? "" : "bubble (me)");
  }
  const Outcome judged = run_nacre({"review", "--set", set, "tutorial-18", "--invalid", "--why", "bent", "--json"});
  EXPECT_EQ(nlohmann::json::parse(judged.out),
            nlohmann::json::parse(R"({"reviewed": [{"specimen": "tutorial-18", "valid": false}]})"));
  const Outcome accepted = run_nacre({"review", "--set", set, "--accept", "--json"});
  EXPECT_EQ(nlohmann::json::parse(accepted.out), nlohmann::json::parse(R"({"reviewed": []})"));
  EXPECT_EQ(run_nacre({"review", "--set", set, "tutorial-19", "--valid", "--why", "?", "--revision", "3"}).status, 2);
  EXPECT_EQ(run_nacre({"review", "--set", set, "nobody", "--invalid", "--why", "?"}).status, 2);
  EXPECT_EQ(run_nacre({"review", "--set", set, "tutorial-19", "--invalid"}).status, 2) << "a reason is wanted";
}

TEST(ReviewProgram, ChangesNothingOfTheSetButTheReviewAndShowsItsWarnings) {
  const fs::path set = fresh_folder("judged");
  std::ofstream(set / "measurements.csv") << "specimen,pattern,test,modulus_pa,curve,note,colour\n"
                                             "A,rigid,modulus,2e9,raw.csv,bent,red\n"
                                             "B,rigid,bending,2e9,,,blue\n";
  const std::string curve = "strain,stress_pa,time_s\n0,0,0\n.1,1,1\n.2,2,2\n.3,3,3\n.4,4,4\n";
  std::ofstream(set / "raw.csv") << curve;
  const Outcome shown = run_nacre({"review", "--set", set.string()});
  EXPECT_THAT(shown.err, HasSubstr("unknown column `colour`"));
  EXPECT_THAT(shown.err, HasSubstr("measurements.csv:3: column test"));
  ASSERT_EQ(run_nacre({"review", "--set", set.string(), "A", "--invalid", "--why", "bubble", "--by", "me"}).status, 0);
  EXPECT_EQ(read_file(set / "measurements.csv"),
            "specimen,pattern,test,modulus_pa,curve,note,colour,valid\n"
            "A,rigid,modulus,2e9,raw.csv,bent; bubble (me),red,0\n"
            "B,rigid,bending,2e9,,,blue,\n");
  EXPECT_EQ(read_file(set / "raw.csv"), curve);
}

constexpr const char* kScenario = R"(rounds = 1
fidelity = "tiny"
[diagnosis]
enabled = false
[proposal]
samples = 12
seeds = 1
population = 6
designs = 1
"redraws" = 1
[validation]
random_patterns = 0
replicates = 2
mixtures = []
calibration_evaluations = 3
modulus_evaluations = 12
approval = true
)";

/// State of each design of a run.
std::map<std::string, std::string> states(const fs::path& run) {
  std::map<std::string, std::string> states;
  for (const auto& design : nlohmann::json::parse(run_nacre({"designs", "--run", run.string(), "--json"}).out))
    states[design["design"]] = design["state"];
  return states;
}

/// One for all: they share the farm's cache.
const fs::path& folder_of_games() {
  static const fs::path folder = fresh_folder("games");
  return folder;
}

TEST(LaboratoryGame, DesignsGoFromPendingToMeasuredAndTheirStatesOutliveEveryProcess) {
  const fs::path folder = fresh_folder("laboratory");
  PersonsGame person(folder_of_games(), "states", kScenario);
  const std::string run = person.run().string();
  person.wait_for("orders of the base materials", [&] { return person.orders().size() == 6; });
  EXPECT_THAT(person.game().said(), HasSubstr("round 1, as expected: 16 specimens on 2 trays, 202 slices,"));
  person.wait_for("a proposal", [&] { return !person.rounds().empty(); });
  const std::string proposed = person.proposals().at(0).designs.at(0).design.name();
  const std::string own = (*pattern::design_from_name("3ffc9b4ad4d2d9")).name();
  EXPECT_EQ(states(person.run()).at(proposed), "pending");
  EXPECT_EQ(states(person.run()).at("soft"), "approved");
  EXPECT_THAT(
      run_nacre({"approve", "--run", run}).out,
      AllOf(HasSubstr(proposed + "  waits for approval "),
            HasSubstr("round 1: 16 specimens on 2 trays, 202 slices, about 2.2 h of printing, 2.7 h of testing,")));
  person.decide({"approve", proposed, "--reject", "--why", "islands"});
  EXPECT_THAT(run_nacre({"approve", "--run", run}).out, HasSubstr(proposed + "  rejected "));
  EXPECT_THAT(person.decide({"approve", "--add", own, "--why", "published"}), HasSubstr("added"));
  person.wait_for("orders of the person's design", [&] { return person.orders().size() == 8; });
  EXPECT_EQ(states(person.run()).at(proposed), "rejected");
  EXPECT_EQ(states(person.run()).at(own), "approved");
  EXPECT_THAT(run_nacre({"designs", "--run", run}).out, HasSubstr("round 1: 16 specimens on 2 trays"));
  const Outcome status = run_nacre({"status", "--run", run});
  EXPECT_THAT(status.out, AllOf(HasSubstr("it cannot be told yet what a round brings"), HasSubstr("round 1: 16 spec")));

  const std::string earlier = (folder / "earlier/job").string(), job = (folder / "job").string();
  const std::vector<std::string> coarse = {"--replicates", "1", "--dpi", "100,100,100"};
  const auto fabricate_one = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "fabricate");
    arguments.insert(arguments.end(), coarse.begin(), coarse.end());
    ASSERT_EQ(run_nacre(arguments).status, 0);
  };
  fabricate_one({"checkerboard:5", "--out", earlier});
  EXPECT_THAT(run_nacre({"printed", earlier, "--run", run}).out, HasSubstr("1 specimen printed"));
  const Outcome printed =
      run_nacre({"fabricate", "--orders", "--run", run, "--out", job, "--dpi", "100,100,100", "--json"}, 120.0);
  ASSERT_EQ(printed.status, 0) << printed.err;
  EXPECT_EQ(nlohmann::json::parse(printed.out)["specimens"].size(), 16U);
  EXPECT_EQ(nlohmann::json::parse(printed.out)["specimens"][0]["label"], "job_2-01") << "job-01 is the run's already";
  EXPECT_THAT(run_nacre({"printed", job, "--run", run, "--tray", "1"}).out, HasSubstr("9 specimens printed, 0 known"));
  EXPECT_THAT(run_nacre({"printed", "job_2", "--run", run}).out, HasSubstr("7 specimens printed, 9 known already"));
  EXPECT_THAT(run_nacre({"printed", job, "--run", run, "--tray", "2", "--undo"}).out,
              HasSubstr("7 specimens no longer"));
  EXPECT_EQ(run_nacre({"printed", job, "--run", run, "--tray", "3"}).status, 2);
  EXPECT_THAT(run_nacre({"designs", "--run", run}).out, HasSubstr("7 specimens to be printed yet"));
  EXPECT_THAT(run_nacre({"printed", job, "--run", run}).out, HasSubstr("7 specimens printed, 9 known already"));
  EXPECT_EQ(run_nacre({"fabricate", "--orders", "--run", run, "--out", job}).status, 1) << "nothing is left to print";
  EXPECT_THAT(run_nacre({"designs", "--run", run}).out, HasSubstr("ml of resin; all are printed"));
  fabricate_one({"checkerboard:2", "--batch", "job", "--out", (folder / "clash").string()});
  const Outcome clash = run_nacre({"printed", (folder / "clash").string(), "--run", run});
  EXPECT_EQ(clash.status, 2);
  EXPECT_THAT(clash.err, HasSubstr("job-01: is printed already"));

  person.game().kill_everything();
  EXPECT_EQ(states(person.run()).at(own), "printed");
  EXPECT_EQ(states(person.run()).at(proposed), "rejected");
  PlayedGame resumed(person.run());
  const auto specimens = person.measured_in_laboratory();
  ASSERT_EQ(specimens.size(), 16U);
  inject(folder / "all", specimens, person.run());
  EXPECT_TRUE(resumed.play_to_end(240.0)) << resumed.said();
  EXPECT_EQ(states(person.run()).at(own), "measured");
  EXPECT_EQ(states(person.run()).at("rigid"), "measured");
  EXPECT_EQ(person.rounds().back().calibration_count, 1) << "the person's design";
  const Outcome over = run_nacre({"status", "--run", run, "--json"});
  EXPECT_EQ(over.status, 1) << "nobody plays";
  const auto next = nlohmann::json::parse(over.out)["next"];
  EXPECT_EQ(next["round"], 2);
  EXPECT_EQ(next["brought"].size(), 1U);
  EXPECT_TRUE(next["is_scatter_of_fit"].get<bool>()) << "one design was predicted";
  EXPECT_GE(next["expected"]["mean_gpa_mpa"].get<double>(), 0.0);
  EXPECT_THAT(next["sentence"].get<std::string>(), HasSubstr("round 2 is expected to bring "));
  EXPECT_EQ(next["price"]["specimens"], 4) << "one design in two tests, twice";
}

/// What `nacre inject` says to one specimen.
Outcome inject_one(const fs::path& set, const measurement::SpecimenRecord& specimen, const fs::path& run,
                   const std::vector<std::string>& more = {}) {
  fs::remove_all(set);
  measurement::write_measurement_set(set, {specimen});
  std::vector<std::string> arguments = {"inject", set.string(), "--run", run.string(), "--by", "a person"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_nacre(arguments, 60.0);
}

TEST(LaboratoryGame, WhatCannotBeMadeIsWithdrawnWhatWasMistypedIsAmendedAndTheGameEnds) {
  const fs::path folder = fresh_folder("corrections");
  PersonsGame person(folder_of_games(), "corrections", kScenario);
  const std::string run = person.run().string();
  person.wait_for("orders of the base materials", [&] { return person.orders().size() == 6; });
  person.decide(
      {"approve", "--withdraw", "r1/rigid/modulus", "--reason", "a jam"});  // base materials are ordered early
  person.wait_for("a proposal", [&] { return !person.rounds().empty(); });
  person.decide({"approve", "--undo", "r1/rigid/modulus"});
  const std::string proposed = person.proposals().at(0).designs.at(0).design.name(), own = "3ffc9b4ad4d2d9";
  EXPECT_THAT(person.decide({"approve", "--withdraw", proposed, "--reason", "too thin"}, 1),
              HasSubstr("waits for approval: reject it instead"));
  person.decide({"approve", proposed});
  person.decide({"approve", "--add", own});
  person.wait_for("orders of both designs", [&] { return person.orders().size() == 6 + 1 + 2 * 2; });  // one again

  person.decide({"approve", "--withdraw", proposed}, 2);  // without a reason
  EXPECT_THAT(person.decide({"approve", "--withdraw", proposed, "--reason", "cannot be printed"}),
              HasSubstr(proposed + ": 2 orders withdrawn"));
  EXPECT_EQ(states(person.run()).at(proposed), "withdrawn");
  EXPECT_THAT(run_nacre({"designs", "--run", run}).out, HasSubstr("a person: cannot be printed"));
  EXPECT_THAT(person.decide({"approve", "--undo", proposed}), HasSubstr(proposed + ": 2 orders given again"));
  EXPECT_EQ(states(person.run()).at(proposed), "approved");
  const std::string toughness = "r1/soft/toughness";
  for (const std::string& each : {proposed, toughness})
    person.decide({"approve", "--withdraw", each, "--reason", "cannot be printed"});
  EXPECT_THAT(person.decide({"approve", "--withdraw", toughness, "--reason", "again"}, 1),
              HasSubstr("was withdrawn by a person: cannot be printed"));
  person.decide({"approve", "--withdraw", "r1/nothing/modulus", "--reason", "?"}, 2);
  const Outcome job = run_nacre(
      {"fabricate", "--orders", "--run", run, "--out", (folder / "job").string(), "--dpi", "100,100,100"}, 120.0);
  ASSERT_EQ(job.status, 0) << job.err;
  EXPECT_THAT(job.out, AllOf(HasSubstr(own), HasSubstr("soft-modulus"), Not(HasSubstr(proposed)),
                             Not(HasSubstr("soft-toughness"))));

  person.game().kill_everything();
  EXPECT_EQ(states(person.run()).at(proposed), "withdrawn");
  PlayedGame resumed(person.run());
  std::vector<measurement::SpecimenRecord> specimens = person.measured_in_laboratory();
  std::erase_if(specimens, [&](const measurement::SpecimenRecord& each) {
    return each.design.name() == proposed || (each.design.name() == "soft" && each.test == tester::TestKind::toughness);
  });
  const auto correct = std::ranges::find_if(specimens, [&](const measurement::SpecimenRecord& each) {
    return each.design.name() == own && each.test == tester::TestKind::modulus;
  });
  measurement::SpecimenRecord mistyped = *correct;
  mistyped.modulus_pa = *measurement::modulus_of(*correct) / 10.0;
  EXPECT_THAT(inject_one(folder / "one", mistyped, person.run()).out, HasSubstr("1 accepted"));
  const Outcome refused = inject_one(folder / "one", *correct, person.run());
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.err, HasSubstr("`nacre inject` with --reason TEXT to amend it"));
  const Outcome amended = inject_one(folder / "one", *correct, person.run(), {"--reason", "decimal point"});
  EXPECT_THAT(amended.out, HasSubstr("0 accepted, 1 amended")) << amended.err;
  EXPECT_THAT(inject_one(folder / "one", *correct, person.run()).out, HasSubstr("1 repeated"));
  EXPECT_THAT(inject_one(folder / "one", mistyped, person.run()).err,
              HasSubstr("(amended by a person: decimal point)"));
  inject(folder / "all", specimens, person.run());
  EXPECT_TRUE(resumed.play_to_end(240.0)) << resumed.said();

  EXPECT_EQ(person.rounds().size(), 2U);
  EXPECT_EQ(person.rounds().back().calibration_count, 1) << "the person's design";
  EXPECT_EQ(states(person.run()).at(proposed), "withdrawn");
  EXPECT_EQ(states(person.run()).at("soft"), "withdrawn");
  EXPECT_EQ(states(person.run()).at(own), "measured");
  for (const char* node : {"validation_agent", "analyser"})
    EXPECT_EQ(run_nacre({"replay", run, "--node", node}).status, 0) << node;
  const auto record = run::Run(person.run()).record();
  const auto kept = std::ranges::find_if(
      record->specimens, [&](const run::MeasuredSpecimen& each) { return each.record.specimen == correct->specimen; });
  ASSERT_NE(kept, record->specimens.end());
  EXPECT_EQ(kept->amendment.why, "decimal point");
  EXPECT_DOUBLE_EQ(*measurement::modulus_of(kept->record), *measurement::modulus_of(*correct));
  std::vector<int> revisions;
  for (const wire::Measurement& taken : measurements_taken(person.run()))
    if (taken.record.specimen == correct->specimen) revisions.push_back(taken.revision);
  EXPECT_EQ(revisions, (std::vector<int>{0, 1})) << "the mistyped value stays in the run";
}

}  // namespace
}  // namespace nacre
