#pragma once
// The farm's executor on a Slurm cluster: tests that the cache does not know go out in batches, a task of a job array
// each. What is done is what has come back and lies in the cache, whatever Slurm says.

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "runtime/work_outbox.hpp"
#include "simulator_farm/batch_plan.hpp"
#include "simulator_farm/slurm.hpp"
#include "simulator_farm/spool.hpp"
#include "store/simulation_cache.hpp"

namespace nacre::simulator_farm {

struct SlurmSettings {
  std::filesystem::path spool;            ///< RUN/slurm, seen by every machine of the cluster under the same path
  std::filesystem::path films;            ///< RUN/films
  std::filesystem::path program;          ///< of the tasks: this one
  std::vector<std::string> options = {};  ///< further options of sbatch
  double batch_s = 20.0;
  double gather_s = 0.2;  ///< tests that come within this time may share a batch
  double poll_s = 5.0;    ///< between two looks at Slurm's list
  Patience patience = {};
  /// Batches that a test is lost with, those that it shared included, until the farm stops with the reason.
  int most_attempts = 5;
};

/// What has happened so far; for people.
struct SlurmCounters {
  int tasks = 0;       ///< given out
  int lost = 0;        ///< tasks that ended without a result, or fell silent
  int duplicates = 0;  ///< results of batches that were over
};

/// Executor of the kind "simulate". All files and commands are dealt with on a thread of its own.
class SlurmExecutor : public runtime::Executor {
 public:
  SlurmExecutor(std::shared_ptr<store::SimulationCache> cache, SlurmSettings settings, std::function<void()> wake);
  /// Tasks that were given out go on: whoever opens the spool next takes their results.
  ~SlurmExecutor() override;
  bool knows(const std::string& kind) const override { return kind == "simulate"; }
  void start(runtime::Compute compute) override;
  std::vector<runtime::FinishedWork> finished() override { return outbox_.finished(); }
  int pending() const override { return outbox_.pending(); }
  std::vector<runtime::LogLine> take_log() override { return outbox_.take_log(); }
  std::string standing() const override { return outbox_.standing(); }

 private:
  /// A test request with whoever waits for its result (after a restart: nobody yet).
  struct OpenTest {
    std::string spec;
    std::optional<runtime::Compute> compute;
    int attempts = 0;  ///< batches it was lost with
  };
  struct InFlight {
    std::vector<OpenTest> tests;
    std::vector<Task> tasks;  ///< that it was given to
    BatchWatch watch;
  };
  struct Submission {
    std::string wave;
    std::vector<std::string> batches;
    RunningCommand command;
  };

  void run();
  void turn();
  void adopt_spool();
  void take_new();
  void sort_test(OpenTest open_test);
  void respond(const runtime::Compute& compute);
  void take_results();
  void take_result(const std::string& batch);
  void look_at_slurm();
  void take_listing(const Listing& listing);
  void give_again(const std::string& batch);
  void cut_batches();
  std::string batch_bytes(const std::vector<OpenTest>& tests) const;
  void put_batch(std::vector<OpenTest> tests);
  void submit();
  void take_submission(const runtime::ProgramOutput& said);
  void give_up(const std::string& reason);
  double now_s() const;

  runtime::WorkOutbox outbox_;

  // Shared with the shell's thread.
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<runtime::Compute> new_;
  bool stopping_ = false;

  // Of the executor's own thread.
  std::shared_ptr<store::SimulationCache> cache_;
  SlurmSettings settings_;
  Spool spool_;
  std::string job_prefix_;
  CostEstimate costs_;
  std::deque<OpenTest> waiting_;
  double waiting_since_s_ = 0.0;
  std::map<std::string, InFlight> in_flight_;  ///< by batch
  std::map<std::string, std::string> batch_of_spec_;
  std::deque<std::string> to_submit_;
  std::optional<Submission> submission_;
  std::optional<RunningCommand> listing_;
  std::set<std::string> asked_batches_;  ///< whose tasks the listing on its way tells
  int refusals_ = 0;                     ///< in a row
  double next_submission_s_ = 0.0, next_listing_s_ = 0.0;
  int next_wave_ = 1;
  int silent_listings_ = 0;
  SlurmCounters counters_;
  std::thread thread_;
};

}  // namespace nacre::simulator_farm
