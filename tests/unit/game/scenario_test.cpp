#include "game/scenario.hpp"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files.hpp"
#include "base/result.hpp"
#include "game/scenario_keys.hpp"

namespace nacre::game {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The message of the InputError that parsing `text` throws; empty when it is accepted.
std::string complaint(const std::string& text) {
  try {
    parse_scenario(text, "s.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

Scenario with_nothing_at_its_default() {
  Scenario s;
  s.name = "other";
  s.seed = 77;
  s.rounds = 9;
  s.fidelity = tester::Fidelity::full;
  s.stop_at_equilibrium = false;
  s.hosts = "lan";
  s.port = 7777;
  s.farm_threads = 3;
  s.benchmark_file = "a \"quoted\" path\\with.csv";
  s.base_materials_file = "b.csv";
  s.model_file = "m.toml";
  s.ranges_file = "r.csv";
  s.discretisation_floor_file = "f.toml";
  s.farm = {"slurm", {"--partition=a b", "--time=\"5\""}, 7};
  s.proposal = {"random", 17, 5, 4, 3, 2};
  s.validation = {1, 2, 1, 4, 5, 6, {0.0, 1.0 / 3.0, 1.0}, true};
  s.diagnosis = {false, 1, 1234, 7};
  s.families = {true, 3, 17, 5, 6, 7};
  s.budget = {1000, 5000};
  s.laboratory = {false, "lab.toml", 2.5, 7.0, 490.0, 390.0};
  return s;
}

TEST(Scenario, WrittenAndReadBackIsTheSame) {
  EXPECT_EQ(parse_scenario(to_toml(Scenario{}), "s"), Scenario{});
  const Scenario other = with_nothing_at_its_default();
  EXPECT_EQ(parse_scenario(to_toml(other), "s"), other);
}

TEST(Scenario, EveryKeyIsWrittenWithACommentAndReachesItsOwnMember) {
  const std::string text = to_toml(with_nothing_at_its_default());
  const std::string defaults = to_toml(Scenario{});
  for (const ScenarioKey& key : scenario_keys()) {
    EXPECT_THAT(text, HasSubstr(fmt::format("\n{} = ", key.name))) << key.path();
    EXPECT_FALSE(key.meaning.empty()) << key.path();
    EXPECT_NE(key.write(with_nothing_at_its_default()), key.write(Scenario{})) << key.path();
  }
}

TEST(Scenario, AbsentKeysHaveTheirDefaults) {
  const Scenario scenario = parse_scenario("rounds = 1\n[proposal]\ndesigns = 8\n", "s");
  EXPECT_EQ(scenario.rounds, 1);
  EXPECT_EQ(scenario.proposal.designs, 8);
  EXPECT_EQ(scenario.proposal.samples, Scenario{}.proposal.samples);
}

TEST(Scenario, UnknownKeyIsNamedWithItsLineAndTheKnownOnes) {
  EXPECT_THAT(complaint("seed = 1\n\n[proposal]\nsample = 3\n"),
              AllOf(HasSubstr("s.toml:4"), HasSubstr("unknown key sample in [proposal]"), HasSubstr("samples")));
  EXPECT_THAT(complaint("sed = 1\n"), AllOf(HasSubstr("s.toml:1"), HasSubstr("unknown key sed"), HasSubstr("seed")));
}

TEST(Scenario, UnknownTableIsNamedWithItsLine) {
  EXPECT_THAT(complaint("seed = 1\n[propsal]\nsamples = 3\n"),
              AllOf(HasSubstr("s.toml:2"), HasSubstr("[propsal]"), HasSubstr("[proposal]")));
  EXPECT_THAT(complaint("[proposal]\n[proposal.inner]\nx = 1\n"), HasSubstr("unknown key inner in [proposal]"));
}

TEST(Scenario, WrongTypeIsAnErrorWithKeyValueAndWhatWasExpected) {
  EXPECT_THAT(complaint("rounds = \"three\"\n"),
              AllOf(HasSubstr("s.toml:1"), HasSubstr("rounds"), HasSubstr("three"), HasSubstr("a whole number")));
  EXPECT_THAT(complaint("rounds = 3.0\n"), HasSubstr("a whole number"));
  EXPECT_THAT(complaint("stop_at_equilibrium = 1\n"), HasSubstr("true or false"));
  EXPECT_THAT(complaint("proposal = 3\n"), HasSubstr("expected a table [proposal]"));
  EXPECT_THAT(complaint("[validation]\nmixtures = [0.5, \"x\"]\n"), HasSubstr("numbers from 0 to 1"));
}

TEST(Scenario, ValueOutOfRangeIsAnErrorWithTheRange) {
  EXPECT_THAT(complaint("port = 65536\n"), AllOf(HasSubstr("port = 65536"), HasSubstr("0 to 65535")));
  EXPECT_THAT(complaint("seed = -1\n"), HasSubstr("from 0"));
  EXPECT_THAT(complaint("name = \"a/b\"\n"), HasSubstr("A-Z"));
  EXPECT_THAT(complaint("fidelity = \"ful\"\n"), HasSubstr("\"full\""));
  EXPECT_THAT(complaint("[proposal]\nalgorithm = \"magic\"\n"), HasSubstr("nsga2"));
  EXPECT_THAT(complaint("[validation]\nmixtures = [1.5]\n"), HasSubstr("from 0 to 1"));
  EXPECT_THAT(complaint("[validation]\nmixtures = [nan]\n"), HasSubstr("from 0 to 1"));
  EXPECT_THAT(complaint("[validation]\nmixtures = [0.5, 0.5]\n"), HasSubstr("different"));
}

TEST(Scenario, ValuesThatContradictEachOtherAreAnError) {
  EXPECT_THAT(complaint("[validation]\nreplicates = 2\nenough_valid = 3\n"),
              AllOf(HasSubstr("s.toml:3:"), HasSubstr("at most validation.replicates")));
  EXPECT_THAT(complaint("[proposal]\nsamples = 2\nseeds = 3\n"),
              AllOf(HasSubstr("s.toml:3:"), HasSubstr("at most proposal.samples")));
  EXPECT_THAT(complaint("[proposal]\nsamples = 1\n"), HasSubstr("s.toml:2:")) << "against a default";
}

TEST(Scenario, BrokenTomlIsAnErrorWithLineAndColumn) {
  EXPECT_THAT(complaint("seed = 1\nrounds = = 3\n"), AllOf(HasSubstr("s.toml:2:"), HasSubstr("not TOML")));
  EXPECT_THAT(complaint("seed = 1\nseed = 2\n"), HasSubstr("s.toml:2:"));
}

TEST(Scenario, ShippedScenariosAreValid) {
  for (const char* name : {"demo", "tiny", "laboratory"}) {
    const Scenario scenario =
        read_scenario(std::filesystem::path(NACRE_SOURCE_DIR) / "launch" / fmt::format("{}.toml", name));
    EXPECT_EQ(scenario.name, name);
    EXPECT_TRUE(std::filesystem::exists(scenario.base_materials_file));
    EXPECT_TRUE(std::filesystem::exists(scenario.discretisation_floor_file));
  }
}

TEST(Scenario, MissingFileIsAnErrorThatNamesTheKey) {
  const auto path = std::filesystem::path(testing::TempDir()) / "missing_file.toml";
  std::ofstream(path) << "[laboratory]\nfile = \"nowhere.toml\"\n";
  try {
    read_scenario(path);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("missing_file.toml:2:8: laboratory.file"), HasSubstr("nowhere.toml")));
  }
}

TEST(Scenario, FilesAreFoundBesideTheScenario) {
  const auto folder = std::filesystem::path(testing::TempDir());
  std::ofstream(folder / "beside.toml") << "[laboratory]\nfile = \"my_lab.toml\"\n";
  std::ofstream(folder / "my_lab.toml") << "seed = 1\n";
  EXPECT_EQ(read_scenario(folder / "beside.toml").laboratory.file, (folder / "my_lab.toml").lexically_normal());
}

TEST(Scenario, EveryKeyStandsInTheGuide) {
  const std::string guide = read_file(std::filesystem::path(NACRE_SOURCE_DIR) / "launch" / "README.md");
  for (const ScenarioKey& key : scenario_keys()) {
    const std::string row = fmt::format("| `{}` | `{}` | ", key.path(), key.write(Scenario{}));
    EXPECT_NE(guide.find(row), std::string::npos) << "launch/README.md lacks a row that begins with\n" << row;
  }
}

TEST(Scenario, NodesTakePartAsTheScenarioSays) {
  Scenario scenario;
  EXPECT_THAT(scenario.nodes(), testing::Contains("virtual_lab"));
  scenario.laboratory.virtual_lab = false;
  EXPECT_THAT(scenario.nodes(), testing::Not(testing::Contains("virtual_lab")));
}

}  // namespace
}  // namespace nacre::game
