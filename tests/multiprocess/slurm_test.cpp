// The farm on a Slurm cluster: a loopback one, started for the test. Whatever happens to tasks, controller, node and
// farm, every test has the result that threads of this machine get, to the last bit. And programs of nodes that
// need no cluster: what a second one, started by mistake, leaves alone.

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include "base/files.hpp"
#include "game/scenario.hpp"
#include "loopback_slurm.hpp"
#include "material/parameters.hpp"
#include "played_game.hpp"
#include "program_test.hpp"
#include "runtime/journal.hpp"
#include "runtime/run_folder.hpp"
#include "short_game.hpp"
#include "simulator_farm/simulate_work.hpp"
#include "simulator_farm/slurm_executor.hpp"
#include "simulator_farm/test_request.hpp"
#include "virtual_lab/kept_responses.hpp"

namespace nacre {
namespace {

using runtime::Compute;
using simulator_farm::SlurmExecutor;
using simulator_farm::SlurmSettings;

constexpr double kPatienceS = 90.0;

/// Test requests of different kinds: two tests, with and without curve, crack, film.
std::vector<Compute> test_computes(int designs) {
  wire::SimulateRequest request;
  request.request_id = "test/1";
  request.fidelity = tester::Fidelity::tiny;
  request.parameters = material::default_parameters();
  std::vector<Compute> computes;
  for (int i = 0; i < designs; ++i) {
    const pattern::Design design = pattern::Mixture{(i + 1.0) / (designs + 1.0)};
    for (const auto test : {tester::TestKind::modulus, tester::TestKind::toughness}) {
      const bool is_toughness = test == tester::TestKind::toughness;
      const simulator_farm::Extras extras{
          .curve = is_toughness && i % 2 == 0, .crack = is_toughness && i % 3 == 0, .film = is_toughness && i % 4 == 0};
      computes.push_back({fmt::format("q{}", computes.size()), "simulate",
                          wire::write(simulator_farm::test_request_of(request, design, {test, 0, extras}))});
    }
  }
  return computes;
}

using Responses = std::map<std::string, std::string>;  ///< by id

/// What threads of this machine get.
Responses local_responses(const std::vector<Compute>& computes, const fs::path& folder) {
  store::SimulationCache cache(folder / "simulations.db");
  Responses responses;
  for (const Compute& compute : computes) {
    responses[compute.id] = simulator_farm::simulate_work(cache, folder / "films", compute.spec);
  }
  return responses;
}

/// Every value of every row of a table, as SQL writes it.
std::vector<std::string> rows(const fs::path& database, const std::string& columns, const std::string& table) {
  SQLite::Database db(database.string(), SQLite::OPEN_READONLY);
  SQLite::Statement query(db, fmt::format("SELECT key, {} FROM {} ORDER BY key", columns, table));
  std::vector<std::string> all;
  while (query.executeStep()) all.push_back(query.getColumn(0).getString() + query.getColumn(1).getString());
  return all;
}

class Cluster : public testing::Test {
 protected:
  static void SetUpTestSuite() { slurm_ = std::make_unique<test::LoopbackSlurm>(fresh_folder("slurm")); }
  static void TearDownTestSuite() { slurm_.reset(); }
  void SetUp() override {
    if (!slurm_->works()) GTEST_SKIP() << "NO SLURM HERE, NOTHING IS TESTED: " << slurm_->reason();
    ASSERT_TRUE(slurm_->becomes_ready(30.0));
    folder_ = fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name());
    open_cache();
  }
  void TearDown() override { executor_.reset(); }

  void open_cache() { cache_ = std::make_shared<store::SimulationCache>(folder_ / "simulations.db"); }
  /// Tasks that take `delay_s` longer than the simulations.
  void open_executor(double delay_s = 0.0, double batch_s = 0.05) {
    const fs::path program = folder_ / "slow_task";
    std::ofstream(program) << fmt::format("#!/bin/sh\nsleep {}\nexec {} \"$@\"\n", delay_s,
                                          nacre::program("nacre_simulator_farm"));
    fs::permissions(program, fs::perms::owner_all);
    executor_ = std::make_unique<SlurmExecutor>(cache_,
                                                SlurmSettings{.spool = folder_ / "slurm",
                                                              .films = folder_ / "films",
                                                              .program = program,
                                                              .batch_s = batch_s,
                                                              .gather_s = 0.1,
                                                              .poll_s = 0.5,
                                                              .patience = {.listing_s = 1.0, .sign_s = 8.0}},
                                                [] {});
  }
  void start(const std::vector<Compute>& computes) {
    for (const Compute& compute : computes) executor_->start(compute);
  }
  /// Collects until `count` responses have come; `every_turn` is called meanwhile.
  void collect(
      std::size_t count, const std::function<void()>& every_turn = [] {}) {
    EXPECT_TRUE(becomes_true(
        [&] {
          slurm_->mend_node();
          every_turn();
          take();
          return responses_.size() >= count;
        },
        kPatienceS))
        << responses_.size() << " of " << count << " responses; " << executor_->standing() << "\n"
        << log_ << slurm_->standing();
  }
  /// Waits for tasks to run. The node of a controller that was killed may be drained long after it looked ready: it is
  /// resumed, as an operator would.
  void await_tasks() {
    ASSERT_TRUE(becomes_true([&] { return slurm_->mend_node(), !tasks().empty(); }, 20.0))
        << log_ << slurm_->standing();
  }
  bool stands(const std::string& words) const {
    return becomes_true([&] { return executor_->standing().find(words) != std::string::npos; }, 5.0);
  }
  void take() {
    for (runtime::FinishedWork& work : executor_->finished()) {
      ASSERT_TRUE(work.result) << work.result.error().message;
      EXPECT_TRUE(responses_.emplace(work.compute.id, *work.result).second) << work.compute.id << " has two responses";
    }
    for (const runtime::LogLine& line : executor_->take_log()) log_ += line.text + "\n";
  }
  /// The tasks' processes at this moment.
  std::vector<int> tasks() const {
    std::vector<int> found = processes_with("/slow_task work --spool " + (folder_ / "slurm").string());
    const auto working = processes_with("nacre_simulator_farm work --spool " + (folder_ / "slurm").string());
    found.insert(found.end(), working.begin(), working.end());
    return found;
  }
  void expect_responses_of_threads(const std::vector<Compute>& computes) {
    const fs::path local = fresh_folder("local_" + folder_.filename().string());
    EXPECT_EQ(responses_, local_responses(computes, local));
    const std::string columns =
        "failure || printf('|%!.17g|%!.17g|%!.17g|%!.17g|', modulus_pa, toughness_pa, peak_stress_pa, failure_strain) "
        "|| hex(curve)";
    EXPECT_EQ(rows(folder_ / "simulations.db", columns, "simulation"),
              rows(local / "simulations.db", columns, "simulation"));
    EXPECT_EQ(rows(folder_ / "simulations.db", "hex(pairs)", "breaks"),
              rows(local / "simulations.db", "hex(pairs)", "breaks"));
    for (const auto& film : fs::directory_iterator(local / "films")) {
      EXPECT_EQ(read_file(film), read_file(folder_ / "films" / film.path().filename()));
    }
  }

  static std::unique_ptr<test::LoopbackSlurm> slurm_;
  fs::path folder_;
  std::shared_ptr<store::SimulationCache> cache_;
  std::unique_ptr<SlurmExecutor> executor_;
  Responses responses_;
  std::string log_;
};

std::unique_ptr<test::LoopbackSlurm> Cluster::slurm_;

TEST_F(Cluster, RespondsAsThreadsDoToTheLastBit) {
  const auto computes = test_computes(12);
  open_executor();
  start(computes);
  collect(computes.size());
  expect_responses_of_threads(computes);
  EXPECT_TRUE(becomes_true([&] { return simulator_farm::Spool(folder_ / "slurm").batches().empty(); }, 5.0));
}

TEST_F(Cluster, WhatTheCacheKnowsNeedsNoTask) {
  const auto computes = test_computes(4);
  for (const Compute& compute : computes) simulator_farm::simulate_work(*cache_, folder_ / "films", compute.spec);
  open_executor();
  start(computes);
  collect(computes.size());
  EXPECT_TRUE(stands(" 0 tasks so far")) << executor_->standing();
  expect_responses_of_threads(computes);
}

TEST_F(Cluster, KilledTasksAreGivenOutAgain) {
  const auto computes = test_computes(4);
  open_executor(1.0);
  start(computes);
  int killed = 0;
  collect(computes.size(), [&] {
    for (const int task : tasks()) {
      if (killed < 4 && ::kill(task, SIGKILL) == 0) ++killed;
    }
  });
  EXPECT_EQ(killed, 4);
  EXPECT_THAT(log_, HasSubstr("it is given out again"));
  expect_responses_of_threads(computes);
}

TEST_F(Cluster, AKilledControllerIsWaitedForAndTakesTasksWhenItIsBack) {
  const auto computes = test_computes(6);
  open_executor(0.5);
  start({computes.begin(), computes.begin() + 6});
  ASSERT_NO_FATAL_FAILURE(await_tasks());
  slurm_->kill_controller();
  start({computes.begin() + 6, computes.end()});
  ASSERT_TRUE(becomes_true([&] { return take(), log_.find("Slurm does not") != std::string::npos; }, 60.0)) << log_;
  slurm_->start_controller();
  EXPECT_TRUE(slurm_->becomes_ready(60.0));
  collect(computes.size());
  expect_responses_of_threads(computes);
}

TEST_F(Cluster, ANodeThatIsGoneIsWaitedForWithItsTasks) {
  const auto computes = test_computes(4);
  open_executor(1.0);
  start(computes);
  ASSERT_NO_FATAL_FAILURE(await_tasks());
  slurm_->kill_node();
  for (const int task : tasks()) ::kill(task, SIGKILL);
  for (const int step : processes_with("slurmstepd")) ::kill(step, SIGKILL);
  ::usleep(2'000'000);
  slurm_->start_node();
  EXPECT_TRUE(slurm_->becomes_ready(60.0));
  collect(computes.size());
  expect_responses_of_threads(computes);
}

TEST_F(Cluster, ATaskThatStandsStillIsDoneByAnotherAndItsLateResultIsNotNeeded) {
  const auto computes = test_computes(2);
  open_executor(1.0, 10.0);
  start(computes);
  ASSERT_NO_FATAL_FAILURE(await_tasks());
  const std::vector<int> stopped = tasks();
  for (const int task : stopped) ::kill(task, SIGSTOP);
  collect(computes.size());
  EXPECT_THAT(log_, HasSubstr("it is given out again"));
  for (const int task : stopped) ::kill(task, SIGCONT);
  EXPECT_TRUE(becomes_true([&] { return tasks().empty(); }, 20.0));
  take();
  EXPECT_EQ(responses_.size(), computes.size());
  expect_responses_of_threads(computes);
}

TEST_F(Cluster, AResultThatComesTwiceOrDamagedChangesNothing) {
  const auto computes = test_computes(2);
  open_executor(2.0, 10.0);
  start(computes);
  const simulator_farm::Spool spool(folder_ / "slurm");
  ASSERT_TRUE(becomes_true([&] { return !spool.batches().empty(); }, 20.0));
  const std::string batch = spool.batches().front();
  std::ofstream(spool.result(batch)) << "torn in two";
  std::ofstream(spool.result("00000000000000000000000000000000")) << "nobody asked for this";
  collect(computes.size());
  EXPECT_THAT(log_, HasSubstr("it is asked for again"));
  expect_responses_of_threads(computes);
  EXPECT_TRUE(becomes_true([&] { return spool.results().empty(); }, 20.0));
}

TEST_F(Cluster, AFarmThatIsStartedAgainTakesTheTasksOfTheOneBefore) {
  const auto computes = test_computes(4);
  open_executor(2.0);
  start(computes);
  ASSERT_TRUE(becomes_true([&] { return tasks().size() >= 1; }, 20.0));
  executor_.reset();
  open_cache();
  open_executor(2.0);
  start(computes);  // what the journal calls open
  collect(computes.size());
  EXPECT_TRUE(stands(" 0 tasks so far")) << executor_->standing();
  expect_responses_of_threads(computes);
}

TEST_F(Cluster, ATestThatKillsItsTasksStopsTheFarmWithTheReason) {
  open_executor();
  const fs::path program = folder_ / "slow_task";
  std::ofstream(program) << "#!/bin/sh\necho cannot load this library >&2\nexit 1\n";
  start({test_computes(1).front()});
  std::string said;
  EXPECT_TRUE(becomes_true(
      [&] {
        for (const auto& work : executor_->finished()) said = work.result ? "answered" : work.result.error().message;
        return !said.empty();
      },
      kPatienceS));
  EXPECT_THAT(said, AllOf(HasSubstr("never came back"), HasSubstr("cannot load this library")));
}

TEST_F(Cluster, AWholeGameIsTheSameAsWithThreads) {
  std::ofstream(folder_ / "threads.toml") << short_game("cluster", 1);
  std::ofstream(folder_ / "slurm.toml") << short_game("cluster", 1) << "[farm]\nexecutor = \"slurm\"\nbatch_s = 1\n";
  std::map<std::string, SentInGame> said;
  for (const std::string executor : {"threads", "slurm"}) {
    if (executor == "slurm") {  // the farm simulates anew, the laboratory need not
      fs::create_directories(folder_ / "slurm");
      fs::copy(folder_ / "threads" / virtual_lab::kKeptFolder, folder_ / "slurm" / virtual_lab::kKeptFolder);
    }
    PlayedGame game(folder_ / (executor + ".toml"), folder_ / executor, "game");
    ASSERT_TRUE(game.play_to_end(200.0)) << game.said();
    ASSERT_EQ(game.status(), 0) << game.said();
    said[executor] = on_channels(sent_in_game(game.folder()), {"PARAMETERS", "GAMUT", "PROPOSAL", "TEST_ORDER",
                                                               "MEASUREMENT", "DIAGNOSIS", "ROUND"});
    EXPECT_FALSE(said[executor].empty());
  }
  EXPECT_THAT(differences(said["threads"], said["slurm"]), IsEmpty());
}

/// A node's program in the run of a test, where `sbatch` is installed and takes nothing.
class NodeProgramTest : public testing::Test {
 protected:
  void SetUp() override {
    const fs::path folder = fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name());
    std::ofstream(folder / "node.toml") << short_game("node", 1);
    run_ = runtime::RunFolder::create(folder, "run", game::read_scenario(folder / "node.toml")).path();
    fs::create_directories(run_ / "bin");
    std::ofstream(run_ / "bin" / "sbatch") << "#!/bin/sh\nexit 0\n";
    fs::permissions(run_ / "bin" / "sbatch", fs::perms::owner_all);
  }
  test::Process start(const std::string& node, const std::vector<std::string>& options = {}) const {
    std::vector<std::string> command = {"env",
                                        fmt::format("PATH={}:{}", (run_ / "bin").string(), std::getenv("PATH")),
                                        program("nacre_" + node),
                                        "--run-dir",
                                        run_.string(),
                                        "--port",
                                        std::to_string(test::test_port())};
    command.insert(command.end(), options.begin(), options.end());
    return test::Process(command, run_ / "errors");
  }
  /// As a node's process that runs holds it.
  std::unique_ptr<runtime::Journal> lock(const std::string& node) const {
    return runtime::Journal::open(run_ / "nodes" / node, 1);
  }
  std::string errors() const { return fs::exists(run_ / "errors") ? read_file(run_ / "errors") : ""; }

  fs::path run_;
};

TEST_F(NodeProgramTest, ASecondFarmIsRefusedBeforeItTouchesWhatTheFirstGaveOut) {
  const auto first = lock("simulator_farm");
  const simulator_farm::Spool spool(run_ / "slurm");
  const std::string name(32, '0');
  spool.put(name, "a batch that the second program could not read");
  std::ofstream(spool.result(std::string(32, '1'))) << "a result that the second program did not ask for";
  test::Process second = start("simulator_farm", {"--executor", "slurm"});
  EXPECT_EQ(second.wait(20.0), 2);
  EXPECT_THAT(errors(), HasSubstr("another process"));
  EXPECT_TRUE(fs::exists(spool.batch_file(name)));
  EXPECT_TRUE(fs::exists(spool.result(std::string(32, '1'))));
}

TEST_F(NodeProgramTest, ASecondAnalyserIsRefusedBeforeItMakesTheDatabaseAnew) {
  const auto first = lock("analyser");
  test::Process second = start("analyser");
  EXPECT_EQ(second.wait(20.0), 2);
  EXPECT_THAT(errors(), HasSubstr("another process"));
  EXPECT_FALSE(fs::exists(run_ / "run.db")) << "made anew: the first one's journal has begun";
}

TEST_F(NodeProgramTest, AnAnalyserThatStartsForTheFirstTimeMakesNothingAnew) {
  test::Process analyser = start("analyser");
  EXPECT_TRUE(becomes_true([&] { return errors().find("listens") != std::string::npos; }, 20.0)) << errors();
  EXPECT_TRUE(fs::exists(run_ / "run.db"));
  EXPECT_THAT(errors(), Not(HasSubstr("made anew")));
}

TEST_F(NodeProgramTest, AFarmWithADeviceHasTheThreadsThatItIsGiven) {
  const auto threads_of = [&](int threads) {
    test::Process farm = start("simulator_farm", {"--executor", "cuda", "--threads", std::to_string(threads), "--cache",
                                                  (run_ / fmt::format("{}.db", threads)).string()});
    EXPECT_TRUE(becomes_true([&] { return errors().find("listens") != std::string::npos; }, 20.0)) << errors();
    // Those of the pool are there from the start; the device's end where there is none, once it has been said.
    becomes_true([&] { return errors().find("the device cannot be used") != std::string::npos; }, 5.0);
    std::ptrdiff_t count = 0;
    int looks_alike = 0;
    EXPECT_TRUE(becomes_true(
        [&] {
          const fs::directory_iterator tasks(fs::path("/proc") / std::to_string(farm.pid()) / "task");
          const auto last = std::exchange(count, std::distance(begin(tasks), end(tasks)));
          looks_alike = last == count ? looks_alike + 1 : 0;
          return looks_alike == 5;
        },
        20.0));
    farm.kill();
    fs::remove(run_ / "errors");
    return count;
  };
  EXPECT_EQ(threads_of(9) - threads_of(1), 8);
}

}  // namespace
}  // namespace nacre
