// The command line as people and scripts meet it: what it answers, and what it says to bad input.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/files.hpp"
#include "material/parameter_file.hpp"
#include "material/parameters.hpp"
#include "program_test.hpp"
#include "runtime/log_file.hpp"
#include "runtime/run_folder.hpp"
#include "wire/convert.hpp"
#include "wire/header.hpp"

namespace nacre {
namespace {

const std::string kPublishedA = std::string(NACRE_SOURCE_DIR) + "/data/patterns/published_a.txt";

class CommandLine : public testing::Test {
 protected:
  void SetUp() override { folder_ = fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name()); }
  std::string file(const std::string& name, const std::string& content) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return (folder_ / name).string();
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

/// 20 lines of `line`.
std::string twenty(const std::string& line) {
  std::string text;
  for (int i = 0; i < 20; ++i) text += line + "\n";
  return text;
}

void expect_refused(const Outcome& outcome, const std::vector<std::string>& words) {
  EXPECT_EQ(outcome.status, 2) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, IsEmpty());
  for (const std::string& word : words) EXPECT_THAT(outcome.err, HasSubstr(word));
}

TEST_F(CommandLine, SimulateAnswersInTheDocumentedForm) {
  const Outcome outcome = run_nacre({"simulate", kPublishedA, "soft", "--fidelity", "tiny", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto document = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(document.size(), 2U);
  EXPECT_EQ(document[0]["pattern"], kPublishedA);
  EXPECT_EQ(document[0]["key"], "577fffe9fffdef");
  for (const char* field :
       {"modulus_pa", "toughness_pa", "peak_stress_pa", "failure_strain", "steps", "element_steps_per_s"}) {
    EXPECT_GT(document[0][field].get<double>(), 0.0) << field;
  }
  EXPECT_LT(document[1]["modulus_pa"].get<double>(), document[0]["modulus_pa"].get<double>());
}

TEST_F(CommandLine, SimulateGivesTheMeanOverSpecimens) {
  const std::vector<std::string> one = {"simulate", "577fffe9fffdef", "--test", "toughness", "--fidelity", "tiny"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), one.begin(), one.end());
    return run_nacre(more);
  };
  const Outcome outcome =
      with({"--specimens", "3", "--strength-cv", "0.1", "--refine", "2", "--curves", path("many"), "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto entry = nlohmann::json::parse(outcome.out)[0];
  ASSERT_EQ(entry["by_specimen"].size(), 3U);
  double sum_pa = 0.0, squares = 0.0;
  for (const auto& each : entry["by_specimen"]) sum_pa += each["toughness_pa"].get<double>();
  for (const auto& each : entry["by_specimen"])
    squares += std::pow(each["toughness_pa"].get<double>() - sum_pa / 3.0, 2);
  EXPECT_DOUBLE_EQ(entry["toughness_pa"], sum_pa / 3.0);
  EXPECT_NEAR(entry["toughness_se_pa"].get<double>(), std::sqrt(squares / 6.0), 1e-6 * sum_pa);
  EXPECT_GT(entry["toughness_se_pa"].get<double>(), 0.0);
  EXPECT_EQ(entry["specimens"], 3);
  EXPECT_EQ(entry["criterion"], "crack_band");
  EXPECT_TRUE(entry["crack"].is_null()) << "of refined elements";
  for (const char* file : {"many/577fffe9fffdef-0.csv", "many/577fffe9fffdef-2.csv"})
    EXPECT_TRUE(fs::exists(path(file))) << file;

  const auto base = nlohmann::json::parse(with({"--json"}).out)[0];
  EXPECT_EQ(base["specimens"], 8);
  EXPECT_EQ(base["strength_cv"], 0.1);
  const auto plain = nlohmann::json::parse(with({"--criterion", "element", "--strength-cv", "0", "--json"}).out)[0];
  EXPECT_FALSE(plain.contains("toughness_se_pa")) << "the thesis' model, whose specimens are all alike";
  const auto with_length = nlohmann::json::parse(with({"--criterion", "neighbourhood", "--json"}).out)[0];
  EXPECT_EQ(with_length["criterion"], "neighbourhood");
  EXPECT_NE(with_length["toughness_pa"], base["toughness_pa"]);
  expect_refused(with({"--criterion", "cohesive"}), {"--criterion", "neighbourhood"});
  EXPECT_THAT(with({"--specimens", "2", "--strength-cv", "0"}).err, HasSubstr("all alike"));
  expect_refused(with({"--strength-cv", "0.5"}), {"--strength-cv", "0.02 to 0.4"});
  expect_refused(with({"--specimens", "0"}), {"--specimens"});
  expect_refused(with({"--refine", "2", "--film", path("fine.gif")}), {"--refine"});
}

TEST_F(CommandLine, SimulateLeavesFieldsOfATestNotRunNull) {
  const Outcome outcome =
      run_nacre({"simulate", "577fffe9fffdef", "--test", "modulus", "--fidelity", "tiny", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto document = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(document[0]["toughness_pa"].is_null());
  EXPECT_TRUE(document[0]["steps"].is_null());
  EXPECT_TRUE(document[0]["modulus_pa"].is_number());
}

TEST_F(CommandLine, SimulateWritesCurvesFilmsAndPictures) {
  const Outcome outcome = run_nacre({"simulate", "mix:0.65", "--test", "toughness", "--fidelity", "tiny", "--specimens",
                                     "1", "--curves", path("curves"), "--frames", path("frames"), "--frame-count", "5",
                                     "--film", path("pictures"), "--film-width", "400"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_GT(fs::file_size(path("curves/mix_0.65.csv")), 100U);
  EXPECT_GT(fs::file_size(path("frames/mix_0.65.film")), 1000U);
  EXPECT_EQ(std::distance(fs::directory_iterator(path("pictures")), {}), 5);
  EXPECT_TRUE(fs::exists(path("pictures/mix_0.65-0004.png")));

  const Outcome drawn = run_nacre({"film", path("frames/mix_0.65.film"), "--out", path("film.gif"), "--width", "400"});
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_GT(fs::file_size(path("film.gif")), 2000U);
  expect_refused(run_nacre({"film", path("curves/mix_0.65.csv"), "--out", path("no.gif")}), {"mix_0.65.csv", "film"});
  expect_refused(run_nacre({"simulate", "soft", "rigid", "--film", path("two.gif")}), {"two.gif", "one specimen"});
  for (const char* files : {"--film", "--frames", "--curves"})
    expect_refused(run_nacre({"simulate", "soft", "--test", "modulus", files, path("no")}), {files, "modulus"});
  const Outcome twice = run_nacre({"simulate", "mix:0.65", "mix:0.65", "--test", "toughness", "--fidelity", "tiny",
                                   "--frames", path("twice"), "--frame-count", "5"});
  EXPECT_EQ(twice.status, 0) << twice.err;
  EXPECT_EQ(read_file(path("twice/mix_0.65.film")), read_file(path("frames/mix_0.65.film")));
}

TEST_F(CommandLine, SimulateTellsTheCrackThatItsFilmShows) {
  const Outcome outcome = run_nacre({"simulate", "rigid", "--test", "toughness", "--fidelity", "tiny", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto crack = nlohmann::json::parse(outcome.out)[0]["crack"];
  EXPECT_EQ(crack["columns"], 40);
  EXPECT_GE(crack["path_ratio"].get<double>(), 1.0);
  EXPECT_EQ(crack["rigid_share"], 1.0);
  EXPECT_EQ(crack["order"].size(), crack["broken"].get<std::size_t>());
  EXPECT_GE(crack["order"].size(), crack["path"].size());
}

TEST_F(CommandLine, SimulateAnswersTheSameTwice) {
  const std::vector<std::string> arguments = {"simulate", "577fffe9fffdef", "--fidelity", "tiny",
                                              "--curves", path("c"),        "--json"};
  auto first = nlohmann::json::parse(run_nacre(arguments).out);
  auto second = nlohmann::json::parse(run_nacre(arguments).out);
  for (auto* document : {&first, &second}) (*document)[0].erase("element_steps_per_s");
  EXPECT_EQ(first, second);
}

TEST_F(CommandLine, MalformedPatternsAreRefusedWithTheirPlace) {
  expect_refused(run_nacre({"simulate", file("letter.txt", twenty("0101010101x101010101"))}),
                 {"letter.txt", "line 1, column 11"});
  expect_refused(run_nacre({"simulate", file("short.txt", twenty("0101010101"))}), {"short.txt", "20"});
  expect_refused(run_nacre({"simulate", file("few.txt", "01010101010101010101\n")}), {"few.txt", "20"});
  expect_refused(run_nacre({"simulate", file("empty.txt", "")}), {"empty.txt"});
  expect_refused(run_nacre({"simulate", "ffffffffffffff"}), {"ffffffffffffff"});
  expect_refused(run_nacre({"simulate", "mix:1.5"}), {"mix:1.5"});
  expect_refused(run_nacre({"simulate", path("nowhere.txt")}), {"nowhere.txt"});
  expect_refused(run_nacre({"simulate", folder_.string()}), {folder_.string()});
}

TEST_F(CommandLine, BadParameterFilesAreRefusedWithLineAndKey) {
  const auto simulate = [&](const std::string& parameters) {
    return run_nacre({"simulate", "soft", "--fidelity", "tiny", "--params", file("p.toml", parameters)});
  };
  expect_refused(simulate("[modulus]\ne_tb_pa = nan\n"), {"p.toml:2", "e_tb_pa"});
  expect_refused(simulate("[modulus]\ne_tb = 1e6\n"), {"p.toml:2", "e_tb"});
  expect_refused(simulate("[modulus]\ne_tb_pa = \"soft\"\n"), {"p.toml:2", "e_tb_pa"});
  expect_refused(simulate("[modulus\n"), {"p.toml:1"});
  expect_refused(run_nacre({"simulate", "soft", "--params", path("nowhere.toml")}), {"nowhere.toml"});
}

TEST_F(CommandLine, WrongUsageIsRefused) {
  expect_refused(run_nacre({"simulate"}), {"PATTERN"});
  expect_refused(run_nacre({"simulate", "soft", "--fidelity", "coarse"}), {"coarse"});
  expect_refused(run_nacre({"simulate", "soft", "--test", "hardness"}), {"hardness"});
  expect_refused(run_nacre({"explore", "--algorithm", "magic", "--out", path("g.csv")}), {"magic"});
  expect_refused(run_nacre({"nonsense"}), {"nonsense: no such command", "simulate"});
  expect_refused(run_nacre({"simulte", "--help"}), {"simulte: no such command; is `simulate` meant?"});
  expect_refused(run_nacre({"launch"}), {"SCENARIO"});
  expect_refused(run_nacre({"launch", "--resume", path("game"), "--run", "other"}), {"--run", "keeps its folder"});
  expect_refused(run_nacre({"launch", "--resume", path("game"), "--logs", path("other")}),
                 {"--logs", "stays in its folder"});
}

TEST_F(CommandLine, FullDiskIsSaidAndNotTakenForSuccess) {
  const Outcome out = run_nacre({"explore", "--fidelity", "tiny", "--budget", "2", "--population", "2", "--batch", "2",
                                 "--out", "/dev/full/gamut.csv"});
  EXPECT_EQ(out.status, 2);
  EXPECT_THAT(out.err, HasSubstr("/dev/full"));
  runtime::ChildProcess process(
      {"/bin/sh", "-c", "exec \"$0\" simulate soft --fidelity tiny --json >/dev/full", program("nacre")});
  std::string said;
  EXPECT_EQ(wait_for_end(process, said).exit_status, 1) << "there may be room later";
  EXPECT_THAT(said, HasSubstr("No space left on device"));
}

TEST_F(CommandLine, WhereResultsGoIsTriedBeforeTheWork) {
  const std::string file = this->file("file", ""), taken = file + "/below";
  const std::string laboratory = this->file("lab.toml", "seed = 7\n");  // in full size, hours of work
  expect_refused(run_nacre({"explore", "--budget", "100000", "--out", taken}), {file});
  expect_refused(run_nacre({"explore", "--budget", "100000", "--out", "/dev/null"}), {"/dev/null: is no regular file"});
  for (const char* where : {"--curves", "--frames", "--film"})
    expect_refused(run_nacre({"simulate", "rigid", kPublishedA, where, taken}), {file});
  expect_refused(run_nacre({"simulate", kPublishedA, "--film", file + "/a.gif"}), {file});
  expect_refused(run_nacre({"measure", "--lab", laboratory, "--out", taken, kPublishedA}), {file});
  expect_refused(run_nacre({"fabricate", "rigid", "--out", taken}), {file});
  ASSERT_EQ(run_nacre({"explore", "--fidelity", "tiny", "--budget", "2", "--population", "2", "--batch", "2", "--out",
                       path("new/folder/g.csv")})
                .status,
            0);
  const std::string parameters = this->file("own.toml", material::to_toml(material::default_parameters()));
  expect_refused(run_nacre({"explore", "--params", parameters, "--budget", "100000", "--out", parameters}),
                 {"own.toml: is read by the same command"});
  std::filesystem::copy(std::string(NACRE_SOURCE_DIR) + "/data/examples/round1", path("set"),
                        std::filesystem::copy_options::recursive);
  const std::string table = path("set/measurements.csv");
  expect_refused(run_nacre({"calibrate", path("set"), "--out", table}), {"is read by the same command"});
  expect_refused(run_nacre({"diagnose", path("set"), "--report", table}), {"is read by the same command"});
  expect_refused(run_nacre({"diagnose", path("set"), "--params", parameters, "--report", parameters}),
                 {"is read by the same command"});
  expect_refused(run_nacre({"explore", "--cache", "c.db", "--budget", "100000", "--out", "./c.db"}), {"c.db: is read"});
}

TEST_F(CommandLine, AStandardErrorThatTakesNothingEndsItInOrder) {
  runtime::ChildProcess process({"/bin/sh", "-c", "exec \"$0\" simulate nonsense 2>/dev/full", program("nacre")});
  std::string said;
  const runtime::ProcessEnd end = wait_for_end(process, said);
  EXPECT_EQ(end.signal, 0);
  EXPECT_EQ(end.exit_status, 2);
}

TEST_F(CommandLine, ScenarioErrorsNameFileLineKeyAndRange) {
  expect_refused(run_nacre({"launch", file("s.toml", "seed = 1\n[proposal]\ndesigns = 0\n"), "--logs", path("logs")}),
                 {"s.toml:3", "proposal.designs", "1 to 100"});
  expect_refused(run_nacre({"launch", file("t.toml", "sead = 1\n"), "--logs", path("logs")}), {"t.toml:1", "sead"});
  expect_refused(run_nacre({"launch", path("nowhere.toml"), "--logs", path("logs")}), {"nowhere.toml"});
  EXPECT_FALSE(fs::exists(path("logs"))) << "nothing is made for a scenario that cannot be played";
}

TEST_F(CommandLine, FilesThatAScenarioNamesAreReadBeforeARunIsMade) {
  const std::string broken = file("broken.toml", "seed = 1\nnot toml\n");
  const std::string table = file("line.csv", "no,such,columns\n1,2,3\n");
  for (const auto& [lines, name] : {std::pair{"model_file = \"broken.toml\"\n", "broken.toml:2"},
                                    {"numerics_floor_file = \"broken.toml\"\n", "broken.toml:2"},
                                    {"ranges_file = \"line.csv\"\n", "line.csv"},
                                    {"benchmark_file = \"line.csv\"\n", "line.csv"},
                                    {"base_materials_file = \"line.csv\"\n", "line.csv"},
                                    {"[laboratory]\nfile = \"broken.toml\"\n", "broken.toml:2"}}) {
    expect_refused(run_nacre({"launch", file("s.toml", lines), "--logs", path("logs")}), {path(name)});
    EXPECT_FALSE(fs::exists(path("logs"))) << lines;
  }
}

TEST_F(CommandLine, ExploreAndSelectWorkHandInHand) {
  const Outcome explored = run_nacre({"explore", "--fidelity", "tiny", "--algorithm", "random", "--budget", "30",
                                      "--out", path("gamut.csv"), "--json"},
                                     120.0);
  ASSERT_EQ(explored.status, 0) << explored.err;
  EXPECT_EQ(nlohmann::json::parse(explored.out)["evaluated"], 30);
  const Outcome more = run_nacre({"explore", "--fidelity", "tiny", "--budget", "10", "--batch", "5", "--known",
                                  path("gamut.csv"), "--out", path("gamut.csv"), "--json"},
                                 120.0);
  ASSERT_EQ(more.status, 0) << more.err;
  EXPECT_EQ(nlohmann::json::parse(more.out)["evaluated"], 40) << "what is known is not simulated again";
  const Outcome selected = run_nacre({"select", path("gamut.csv"), "--count", "3", "--json"});
  ASSERT_EQ(selected.status, 0) << selected.err;
  const auto document = nlohmann::json::parse(selected.out);
  EXPECT_EQ(document.size(), 3U);
  for (const char* field : {"key", "modulus_pa", "toughness_pa", "reason", "bin"})
    EXPECT_TRUE(document[0].contains(field));
}

/// A measurement set in which the homogeneous line has its middle at this name.
std::string homogeneous_line(const std::string& middle) {
  std::string table = "specimen,pattern,test,orientation_deg,modulus_pa,toughness_pa\n";
  const auto add = [&](const std::string& design, int orientation_deg, double modulus_pa, double toughness_pa) {
    const std::string name = fmt::format("{}-{}", design, orientation_deg);
    table += fmt::format("{}-E,{},modulus,{},{},\n", name, design, orientation_deg, modulus_pa);
    table += fmt::format("{}-T,{},toughness,{},,{}\n", name, design, orientation_deg, toughness_pa);
  };
  add("rigid", 0, 2e9, 1e5);
  add(middle, 0, 1.2e9, 4e5);
  add("soft", 0, 1e6, 6e5);
  add("mix:0.7", 90, 9e9, 9e6);  // turned: no competitor of upright designs
  return table;
}

TEST_F(CommandLine, SelectDrawsTheHomogeneousLineByRigidFraction) {
  const std::string gamut = file("gamut.csv",
                                 "index,pattern,rigid_fraction,modulus_pa,toughness_pa\n"
                                 "0,577fffe9fffdef,0.8,1.1e9,5e5\n1,3ffc9b4ad4d2d9,0.6,1.5e9,3.5e5\n"
                                 "2,39647e81c943cf,0.5,1.6e9,3e5\n3,13c4e17fb6f8fd,0.5,8e8,4.3e5\n");
  const auto selected = [&](const std::string& middle) {
    file(middle + "/measurements.csv", homogeneous_line(middle));
    return run_nacre({"select", gamut, "--measured", path(middle), "--count", "4", "--json"});
  };
  const Outcome interface = selected("mix:0.5"), beside = selected("mix:0.5001");  // their names sort elsewhere
  ASSERT_EQ(interface.status, 0) << interface.err;
  EXPECT_EQ(interface.out, beside.out);
  EXPECT_EQ(nlohmann::json::parse(interface.out).size(), 3U) << "the last one lies below middle and soft";
}

TEST_F(CommandLine, SelectRefusesBrokenGamuts) {
  expect_refused(run_nacre({"select", file("empty.csv", "")}), {"empty.csv"});
  expect_refused(run_nacre({"select", file("nan.csv",
                                           "index,pattern,rigid_fraction,modulus_pa,toughness_pa\n"
                                           "0,577fffe9fffdef,0.8,nan,1e5\n")}),
                 {"nan.csv", "2", "modulus_pa"});
}

TEST_F(CommandLine, InterruptedExploreKeepsTheGamutSoFar) {
  runtime::ChildProcess process(
      {program("nacre"), "explore", "--fidelity", "tiny", "--budget", "100000", "--out", path("g.csv")});
  ASSERT_TRUE(becomes_true([&] { return fs::exists(path("g.csv")); }, 60.0));
  process.signal_group(SIGINT);
  std::string said;
  EXPECT_EQ(wait_for_end(process, said).exit_status, 1) << said;
  std::ifstream gamut(path("g.csv"));
  EXPECT_GT(std::count(std::istreambuf_iterator<char>(gamut), {}, '\n'), 5);
}

TEST_F(CommandLine, AnInterruptedConversationGoesOn) {
  const std::string request = R"({"request": "test", "patterns": ["577fffe9fffdef"], "specimens": 5000})";
  const std::string command = "exec \"$0\" explore --ask-tell --fidelity tiny --budget 10000 --out \"$1\" < \"$2\"";
  runtime::ChildProcess process({"/bin/sh", "-c", command, program("nacre"), path("g.csv"), file("in", request)});
  ASSERT_TRUE(
      becomes_true([&] { return fs::exists(path("g.csv.log")) && fs::file_size(path("g.csv.log")) > 0; }, 60.0));
  process.signal_group(SIGINT);
  std::string said;
  EXPECT_EQ(wait_for_end(process, said).exit_status, 1) << said;
  const std::string log = read_file(path("g.csv.log"));
  runtime::ChildProcess again(
      {"/bin/sh", "-c", command, program("nacre"), path("g.csv"), file("faulty", "{\"request\": \"asks\"}\n")});
  said.clear();
  EXPECT_EQ(wait_for_end(again, said).exit_status, 2) << said;
  const auto standing = nlohmann::json::parse(said.substr(0, said.find('\n')));
  EXPECT_EQ(standing["tests_left"], 10000 - std::ranges::count(log, '\n'));
  EXPECT_THAT(said, HasSubstr("line 1: `request` = \\\"asks\\\""));
  EXPECT_THAT(read_file(path("g.csv")), HasSubstr("577fffe9fffdef"));
}

TEST_F(CommandLine, AKilledExploreGoesOnWhereItWas) {
  const auto command = [&](const std::string& out, const std::string& cache) {
    return std::vector<std::string>{"explore",  "--fidelity", "tiny",         "--algorithm", "learned",
                                    "--budget", "25",         "--population", "10",          "--batch",
                                    "5",        "--cache",    cache,          "--out",       out};
  };
  ASSERT_EQ(run_nacre(command(path("whole.csv"), path("whole.db"))).status, 0);
  std::vector<std::string> killed = command(path("killed.csv"), path("killed.db"));
  killed.insert(killed.begin(), program("nacre"));
  runtime::ChildProcess process(killed);
  ASSERT_TRUE(becomes_true([&] { return fs::exists(path("killed.csv")); }, 60.0));
  process.signal_group(SIGKILL);
  std::string said;
  wait_for_end(process, said);
  ASSERT_EQ(run_nacre(command(path("killed.csv"), path("killed.db"))).status, 0);
  const auto contents = [](const std::string& file) {
    std::ifstream in(file);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(contents(path("killed.csv")), contents(path("whole.csv")));
  EXPECT_EQ(contents(path("killed.csv.batches")), contents(path("whole.csv.batches")));
}

TEST_F(CommandLine, MeasureWritesASetAndSealsTheTruthBesideIt) {
  const std::string laboratory = file("lab.toml", "seed = 3\nfidelity = \"tiny\"\nreplicates = 2\n");
  const Outcome outcome = run_nacre({"measure", "--lab", laboratory, "--out", path("set"), "577fffe9fffdef", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["specimens"], 4);
  EXPECT_TRUE(fs::exists(path("set/measurements.csv")));
  EXPECT_TRUE(fs::exists(path("set.truth.toml")));
  expect_refused(run_nacre({"measure", "--lab", file("bad.toml", "sede = 3\n"), "--out", path("x"), "soft"}),
                 {"bad.toml:1:8", "sede"});
}

TEST_F(CommandLine, CalibrateFindsTheModulusOfASetAndWritesParametersThatSimulateTakes) {
  const std::string laboratory = file("lab.toml", "seed = 3\nfidelity = \"tiny\"\nreplicates = 1\n");
  ASSERT_EQ(run_nacre({"measure", "--lab", laboratory, "--out", path("set"), "--test", "modulus", "577fffe9fffdef",
                       "3ffc9b4ad4d2d9", "39647e81c943cf", "13c4e17fb6f8fd"})
                .status,
            0);
  const Outcome outcome = run_nacre({"calibrate", path("set"), "--fidelity", "tiny", "--modulus-budget", "40",
                                     "--budget", "0", "--hold-out", "1", "--out", path("p.toml"), "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto document = nlohmann::json::parse(outcome.out);
  EXPECT_LT(document["after"]["fitted"]["E_mean"].get<double>(), document["before"]["fitted"]["E_mean"].get<double>());
  EXPECT_TRUE(document["after"]["held_out"]["E_mean"].is_number());
  EXPECT_TRUE(document["after"]["fitted"]["T_mean"].is_null()) << "nothing was measured";
  EXPECT_TRUE(document["parameters"]["modulus.e_vw_pa"]["interval90"].is_array());
  EXPECT_GT(document["simulations"], 0);
  EXPECT_EQ(run_nacre({"simulate", "soft", "--fidelity", "tiny", "--params", path("p.toml")}).status, 0);
}

TEST_F(CommandLine, CalibrateFitsBaseMaterialsAndNamesWhatItLeavesOut) {
  const std::string laboratory = file("lab.toml", "seed = 3\nfidelity = \"tiny\"\nreplicates = 1\n");
  ASSERT_EQ(
      run_nacre({"measure", "--lab", laboratory, "--out", path("set"), "--test", "modulus", "soft", "mix:0.3"}).status,
      0);
  const Outcome outcome =
      run_nacre({"calibrate", path("set"), "--fidelity", "tiny", "--out", path("p.toml"), "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto document = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(document["fitted"], nlohmann::json({"soft"}));
  EXPECT_EQ(document["left_out"], nlohmann::json({"mix:0.3"}));
  EXPECT_THAT(outcome.err, HasSubstr("mix:0.3: left out"));
}

TEST_F(CommandLine, FamiliesGroupsSamplesAndMapsWhatWasMeasured) {
  const std::string laboratory = file("lab.toml", "seed = 3\nfidelity = \"tiny\"\nreplicates = 2\n");
  ASSERT_EQ(
      run_nacre({"measure", "--lab", laboratory, "--out", path("set"), "577fffe9fffdef", "3ffc9b4ad4d2d9"}).status, 0);
  const std::vector<std::string> command = {"families", path("set"), "--fidelity", "tiny",          "--samples",
                                            "20",       "--rank",    "3",          "--calibration", "2",
                                            "--cracks", "20",        "--out",      path("found"),   "--json"};
  constexpr double kPatienceS = 600.0;  // it takes 35 s of a fast core, 80 s of a slow one
  const Outcome outcome = run_nacre(command, kPatienceS);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto document = nlohmann::json::parse(outcome.out);
  std::size_t seeds = 0;
  for (const auto& family : document) {
    EXPECT_GE(family["samples"].get<int>(), 20);
    for (const auto& map : family["maps"]) {
      EXPECT_TRUE(fs::exists(
          path("found/" + family["name"].get<std::string>() + "/" + map["seed"].get<std::string>() + ".csv")));
      ++seeds;
    }
  }
  EXPECT_EQ(seeds, 2U);
  const Outcome again = run_nacre(command);  // from what it kept
  EXPECT_EQ(again.out, outcome.out);
  EXPECT_THAT(outcome.err, Not(HasSubstr("families.toml")));
  EXPECT_THAT(again.err, AllOf(HasSubstr("found/families.toml"), Not(HasSubstr("warning"))));
  file("found/families.toml", "[[family]]\nname = \"mine\"\nseeds = [\"577fffe9fffdef\"]\n");
  const Outcome edited = run_nacre(command, kPatienceS);
  EXPECT_EQ(nlohmann::json::parse(edited.out).at(0)["name"], "mine");
  EXPECT_THAT(edited.err, HasSubstr("other families than these measurements propose"));
  std::vector<std::string> propose = command;
  propose.push_back("--propose");
  const auto proposed = nlohmann::json::parse(run_nacre(propose).out);
  EXPECT_EQ(proposed["file"], path("found/families.toml"));
  EXPECT_EQ(proposed["families"].at(0)["seeds"], nlohmann::json({"577fffe9fffdef"}));
  file("found/families.toml", "[[family]]\nname = \"mine\"\nseeds = [\"577\"]\n");
  expect_refused(run_nacre(command), {"families.toml:3", "577"});
}

TEST_F(CommandLine, MeasurementSetsThatCannotBeUsedAreRefusedWithTheirPlace) {
  const std::string head = "specimen,pattern,test,modulus_pa,toughness_pa,curve\n";
  const auto calibrate = [&](const std::string& set) {
    return run_nacre({"calibrate", path(set), "--fidelity", "tiny", "--out", path("p.toml")});
  };
  file("empty/measurements.csv", "");
  expect_refused(calibrate("empty"), {"measurements.csv"});
  file("nan/measurements.csv", head + "a,577fffe9fffdef,modulus,nan,,\n");
  expect_refused(calibrate("nan"), {"measurements.csv", "modulus_pa"});
  file("nocurve/measurements.csv", head + "a,577fffe9fffdef,toughness,,,curves/nowhere.csv\n");
  expect_refused(calibrate("nocurve"), {"nowhere.csv"});
  expect_refused(calibrate("nofolder"), {"nofolder"});
}

TEST_F(CommandLine, RowsThatCannotBeUsedAreListedWithTheirLine) {
  file("set/measurements.csv",
       "specimen,pattern,test,modulus_pa\na,577fffe9fffdef,modulus,1.4e9\n"
       "b,577fffe9fffdef,modulus,x\nc,577fffe9fffdef,modulus,1e9,surplus\n");
  const Outcome outcome = run_nacre({"calibrate", path("set"), "--fidelity", "tiny", "--modulus-budget", "2",
                                     "--budget", "0", "--out", path("p.toml"), "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto rejected = nlohmann::json::parse(outcome.out).at("rejected");
  ASSERT_EQ(rejected.size(), 2U);
  EXPECT_EQ(rejected[0]["line"], 3);
  EXPECT_EQ(rejected[0]["column"], "modulus_pa");
  EXPECT_THAT(rejected[0]["reason"].get<std::string>(), HasSubstr("expected"));
  EXPECT_THAT(outcome.err, HasSubstr(path("set/measurements.csv:3: column modulus_pa: ")));
  EXPECT_THAT(outcome.err, HasSubstr(path("set/measurements.csv:4: has 5 cells")));
}

game::Scenario scenario_without_files() {
  game::Scenario scenario;
  scenario.base_materials_file.clear();
  scenario.discretisation_floor_file.clear();
  return scenario;
}

TEST_F(CommandLine, InjectKeepsBackAModulusInAnotherUnitAndSendsTheRest) {
  auto run = runtime::RunFolder::create(folder_ / "logs", "unheard", scenario_without_files());
  run.set_port(runtime::PortReservation(0).port());
  const std::string head = "specimen,pattern,test,modulus_pa\n";
  file("set/measurements.csv", head + "a,rigid,modulus,0.4\nb,rigid,modulus,2e9\n");
  const std::vector<std::string> command = {"inject",      path("set"), "--run", run.path().string(),
                                            "--timeout-s", "0.2",       "--json"};
  const Outcome outcome = run_nacre(command);
  EXPECT_EQ(outcome.status, 1) << "nobody is there to take the good one" << outcome.err;
  const auto delivery = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(delivery["unanswered"], 1);
  ASSERT_EQ(delivery["rejected"].size(), 1U);
  EXPECT_EQ(delivery["rejected"][0]["line"], 2);
  EXPECT_EQ(delivery["rejected"][0]["column"], "modulus_pa");
  EXPECT_THAT(delivery["rejected"][0]["reason"].get<std::string>(), HasSubstr("is the unit Pa?"));
  EXPECT_THAT(outcome.err, HasSubstr("measurements.csv:2: column modulus_pa: 0.4 Pa"));
  file("set/measurements.csv", head + "a,rigid,modulus,0.4\n");
  expect_refused(run_nacre(command), {"none of its 1 specimens can be sent"});
}

TEST_F(CommandLine, CommandsThatNeedARunSayWhatIsMissing) {
  for (const char* command : {"status", "report"}) {
    expect_refused(run_nacre({command, "--run", path("norun")}), {"norun", "manifest.json"});
  }
  expect_refused(run_nacre({"inject", path("set"), "--run", path("norun")}), {"norun"});
  expect_refused(run_nacre({"echo", "NOISE"}), {"NOISE", "MEASUREMENT"});
  expect_refused(run_nacre({"echo", "--log", folder_.string()}), {folder_.string(), "expected a log: RUN/run.lcm"});
  expect_refused(run_nacre({"export", "--mcap", folder_.string()}), {folder_.string(), "holds no run.lcm; expected"});
  expect_refused(run_nacre({"export", folder_.string()}), {"expected --mcap or --csv"});
  expect_refused(run_nacre({"export", "--csv", "--mcap", folder_.string()}), {"expected --mcap or --csv"});
  expect_refused(run_nacre({"export", "--mcap", file("noise.lcm", "noise")}), {"noise.lcm: no LCM log"});
}

/// Writes a log of three reviews; its bytes.
std::string three_reviews(const fs::path& log) {
  runtime::LogWriter writer(log);
  for (const std::string name : {"first", "second", "third"}) {
    wire::Review review;
    review.specimen = name;
    EXPECT_TRUE(writer.append(1, "REVIEW", wire::stamp_header("REVIEW", wire::write(review), {1, "a", 1, 1, "run"})));
  }
  EXPECT_TRUE(writer.flush());
  return read_file(log);
}

TEST_F(CommandLine, ReplayOfAJournalSaysWhatIsExpected) {
  three_reviews(fs::path(file("nodes/analyser/node.log", "")).parent_path() / "journal.lcm");
  expect_refused(run_nacre({"replay", path("nodes/analyser/journal.lcm"), "--node", "analyser"}),
                 {"is a node's journal, expected the run's folder or its run.lcm"});
}

TEST_F(CommandLine, EchoReadsOnBehindDamageAndNamesItsPlace) {
  std::string bytes = three_reviews(path("run.lcm"));
  bytes[bytes.find("\xED\xA1\xDA\x01", 1)] = 'x';
  file("run.lcm", bytes);
  const Outcome outcome = run_nacre({"echo", "REVIEW", "--log", path("run.lcm")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("first"), Not(HasSubstr("second")), HasSubstr("third")));
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("damaged at byte"), HasSubstr("the next sound record starts at byte")));
}

TEST_F(CommandLine, EchoOfATornLogPrintsWhatIsWholeAndSaysSo) {
  const std::string bytes = three_reviews(path("run.lcm"));
  file("run.lcm", bytes.substr(0, bytes.size() - 3));
  const Outcome outcome = run_nacre({"echo", "--log", path("run.lcm")});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("second"), Not(HasSubstr("third"))));
  EXPECT_THAT(outcome.err, HasSubstr("ends in a torn record"));
}

TEST_F(CommandLine, EchoOfARunThatDoesNotPlaySaysSoAndWaitsForIt) {
  auto run = runtime::RunFolder::create(folder_ / "logs", "unheard", scenario_without_files());
  run.set_port(runtime::PortReservation(0).port());
  runtime::ChildProcess echo({program("nacre"), "echo", "ROUND", "--run", run.path().string()});
  std::string said;
  EXPECT_TRUE(wait_until_said(echo, "the run does not play", said, 20.0)) << said;
  EXPECT_THAT(said, HasSubstr("--log " + (run.path() / "run.lcm").string()));
  EXPECT_FALSE(echo.poll_end()) << "it may begin to play";
  echo.signal_group(SIGINT);
  EXPECT_EQ(wait_for_end(echo, said).exit_status, 0) << said;
}

TEST_F(CommandLine, DoctorNamesEveryCheckWithAVerdict) {
  const Outcome outcome = run_nacre({"doctor", "--logs", folder_.string(), "--json"});
  const auto findings = nlohmann::json::parse(outcome.out);
  bool any_fault = false;
  for (const auto& finding : findings) {
    any_fault = any_fault || finding["verdict"] == "fault";
    EXPECT_EQ(finding["verdict"] == "good", finding["remedy"].get<std::string>().empty()) << finding;
  }
  EXPECT_EQ(outcome.status, any_fault ? 1 : 0);
  const Outcome nowhere = run_nacre({"doctor", "--logs", path("nowhere"), "--json"});
  EXPECT_EQ(nowhere.status, 1);
  EXPECT_THAT(nowhere.out, HasSubstr("mkdir -p"));
}

TEST_F(CommandLine, DoctorAndDashboardTakeARunAsTheOthersDo) {
  for (const char* command : {"doctor", "dashboard"})
    expect_refused(run_nacre({command, "--run", path("norun")}), {"norun", "manifest.json"});
  const auto run = runtime::RunFolder::create(folder_ / "logs", "played", scenario_without_files());
  std::ofstream(run.path() / "run.db") << twenty("this is no database");
  const Outcome outcome = run_nacre({"doctor", "--run", run.path().string(), "--json"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("nacre rebuild --run " + fs::canonical(run.path()).string()));
}

TEST_F(CommandLine, DoctorFindsADatabaseThatIsNone) {
  file("simulations.db", twenty("this is no database"));
  const Outcome outcome = run_nacre({"doctor", "--logs", folder_.string(), "--json"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("simulations.db"));
}

}  // namespace
}  // namespace nacre
