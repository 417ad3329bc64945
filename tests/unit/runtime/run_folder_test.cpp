#include "runtime/run_folder.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files.hpp"
#include "runtime/run_copy.hpp"
#include "temporary_folder.hpp"

namespace nacre::runtime {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  return names;
}

game::Scenario scenario_without_files() {
  game::Scenario scenario;
  scenario.base_materials_file = scenario.discretisation_floor_file = "";
  return scenario;
}

TEST(RunFolder, HalfOfARunIsNotLeftInTheWayOfItsName) {
  const TemporaryFolder logs;
  game::Scenario scenario = scenario_without_files();
  scenario.model_file = logs.path() / "nowhere.toml";
  EXPECT_THROW(RunFolder::create(logs.path(), "game", scenario), InputError);
  EXPECT_THAT(names_in(logs.path()), IsEmpty());
  const RunFolder run = RunFolder::create(logs.path(), "game", scenario_without_files());
  EXPECT_THAT(names_in(logs.path()), UnorderedElementsAre("game", "latest"));
  EXPECT_THROW(RunFolder::create(logs.path(), "game", scenario_without_files()), InputError);
  EXPECT_TRUE(fs::exists(run.scenario_file())) << "of a name that is taken nothing is removed";
}

TEST(RunCopy, ThatFailsLeavesNothingAndMayBeTriedAgain) {
  const TemporaryFolder folder;
  const fs::path run = folder.path() / "run", to = folder.path() / "copies" / "run";
  fs::create_directories(run / "nodes");
  for (const char* file : {"scenario.toml", "run.db"}) std::ofstream(run / file) << "x";
  const auto fails = [](const fs::path& from, const fs::path& copy) {
    fs::copy_file(from, copy);
    throw InputError("it could not be copied whole");
  };
  EXPECT_THROW(copy_run(run, to, fails), InputError);
  EXPECT_THAT(names_in(to.parent_path()), IsEmpty());
  const auto succeeds = [](const fs::path& from, const fs::path& copy) { fs::copy_file(from, copy); };
  EXPECT_EQ(copy_run(run, to, succeeds).files, 2);
  EXPECT_THAT(names_in(to.parent_path()), UnorderedElementsAre("run"));
  EXPECT_THAT(names_in(to), UnorderedElementsAre("scenario.toml", "run.db"));
}

}  // namespace
}  // namespace nacre::runtime
