// A game without the virtual laboratory: the nodes are the real ones, a person brings the measurements.

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class InjectedGame : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name());
    std::ofstream(folder_ / "person.toml") << "name = \"person\"\nrounds = 1\nfidelity = \"tiny\"\n"
                                              "[proposal]\nsamples = 8\nseeds = 1\npopulation = 4\ndesigns = 1\n"
                                              "[validation]\nrandom_patterns = 2\nreplicates = 1\nmixtures = []\n"
                                              "calibration_evaluations = 3\nmodulus_evaluations = 12\n"
                                              "[diagnosis]\nenabled = false\n[laboratory]\nvirtual_lab = false\n";
    std::ofstream(folder_ / "lab.toml") << "seed = 5\nfidelity = \"tiny\"\nreplicates = 1\n";
    launch_ = std::make_unique<runtime::ChildProcess>(
        std::vector<std::string>{program("nacre"), "launch", (folder_ / "person.toml").string(), "--logs",
                                 (folder_ / "logs").string(), "--run", "game"});
  }
  void TearDown() override {
    if (launch_) ::kill(launch_->pid(), SIGINT);
    if (launch_) wait_for_end(*launch_, said_, 20.0);
    if (HasFailure()) std::fputs(said_.c_str(), stderr);
  }

  fs::path run() const { return folder_ / "logs" / "game"; }
  /// Messages of one channel in the validation agent's journal.
  std::vector<nlohmann::json> journal(const std::string& channel) const {
    const fs::path file = run() / "nodes" / "validation_agent" / "journal.lcm";
    std::vector<nlohmann::json> messages;
    if (!fs::exists(file)) return messages;
    std::istringstream lines(run_nacre({"echo", channel, "--log", file.string()}).out);
    for (std::string line; std::getline(lines, line);) messages.push_back(nlohmann::json::parse(line)["message"]);
    return messages;
  }
  /// What the agent has ordered: design and test, each as a specimen would be measured.
  std::set<std::string> ordered_designs() const {
    std::set<std::string> designs;
    for (const auto& order : journal("TEST_ORDER")) designs.insert(order["design"].get<std::string>());
    return designs;
  }
  void measure(const std::string& set, const std::set<std::string>& designs) const {
    std::vector<std::string> arguments = {"measure", "--lab", (folder_ / "lab.toml").string(), "--out",
                                          (folder_ / set).string()};
    arguments.insert(arguments.end(), designs.begin(), designs.end());
    const Outcome outcome = run_nacre(arguments, 120.0);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  /// A set with the first specimens of another.
  void copy_part(const std::string& from, const std::string& to, int specimens) const {
    fs::create_directories(folder_ / to);
    fs::copy(folder_ / from, folder_ / to, fs::copy_options::recursive);
    std::ifstream whole(folder_ / from / "measurements.csv");
    std::ofstream part(folder_ / to / "measurements.csv");
    std::string line;
    for (int i = 0; i <= specimens && std::getline(whole, line); ++i) part << line << "\n";
  }
  static void replace_in(const fs::path& file, const std::string& old_text, const std::string& new_text) {
    std::ifstream in(file);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::size_t place = text.find(old_text);
    ASSERT_NE(place, std::string::npos) << text;
    std::ofstream(file) << text.replace(place, old_text.size(), new_text);
  }
  nlohmann::json inject(const std::string& set, int expected_status = 0) const {
    const Outcome outcome = run_nacre({"inject", (folder_ / set).string(), "--run", run().string(), "--json"}, 120.0);
    EXPECT_EQ(outcome.status, expected_status) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }

  fs::path folder_;
  std::unique_ptr<runtime::ChildProcess> launch_;
  std::string said_;
};

TEST_F(InjectedGame, GoesOnWithWhatAPersonMeasuresAndTakesEverySpecimenOnce) {
  ASSERT_TRUE(wait_until_said(*launch_, "round 0: gap", said_, 180.0));
  ASSERT_TRUE(becomes_true([&] { return ordered_designs().size() >= 3; }, 60.0)) << "orders of round 1";
  const std::set<std::string> designs = ordered_designs();
  measure("whole", designs);
  copy_part("whole", "part", 2);
  EXPECT_EQ(inject("part")["accepted"], 2);
  copy_part("whole", "changed", 1);
  replace_in(folder_ / "changed" / "measurements.csv", ",batch-1,", ",batch-9,");
  EXPECT_EQ(inject("changed", 1)["conflicting"].size(), 1U) << "another measurement under the same name";
  const auto whole = inject("whole");
  EXPECT_EQ(whole["repeated"], 2) << whole;
  EXPECT_EQ(whole["accepted"], 2 * designs.size() - 2) << whole;

  ASSERT_TRUE(wait_until_said(*launch_, "the game is over", said_, 180.0));
  EXPECT_EQ(wait_for_end(*launch_, said_, 30.0).exit_status, 0);
  launch_.reset();
  EXPECT_EQ(journal("MEASUREMENT").size(), 2 * designs.size());
  EXPECT_EQ(journal("ROUND").size(), 2U);
  for (const char* node : {"validation_agent", "proposal_agent", "simulator_farm", "analyser"}) {
    EXPECT_EQ(run_nacre({"replay", run().string(), "--node", node}).status, 0) << node;
  }
}

TEST_F(InjectedGame, InjectSaysWhenNobodyAnswers) {
  ASSERT_TRUE(wait_until_said(*launch_, "the game begins", said_, 60.0));
  ::kill(launch_->pid(), SIGINT);
  wait_for_end(*launch_, said_, 30.0);
  launch_.reset();
  measure("set", {"577fffe9fffdef"});
  const Outcome outcome =
      run_nacre({"inject", (folder_ / "set").string(), "--run", run().string(), "--timeout-s", "1"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("did not answer"));
}

}  // namespace
}  // namespace nacre
