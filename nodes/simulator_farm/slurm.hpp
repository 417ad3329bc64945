#pragma once
// The two commands to Slurm: submit these tasks, list their states. Commands run beside the caller, so that a
// controller that does not respond holds up nothing else.

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "runtime/process.hpp"
#include "simulator_farm/batch_plan.hpp"

namespace nacre::simulator_farm {

/// A command on its way. Given up after `limit_s`.
class RunningCommand {
 public:
  /// A program that cannot be started is an output with exit status kProgramNotFound.
  RunningCommand(const std::vector<std::string>& command, double now_s, double limit_s = 60.0);
  /// What it printed and how it ended; nothing while it runs.
  std::optional<runtime::ProgramOutput> poll(double now_s);

 private:
  std::unique_ptr<runtime::ChildProcess> process_;
  std::string output_;
  double end_s_;
};

/// An array of tasks that is submitted at once.
struct Wave {
  std::string name;  ///< of the job
  int tasks = 0;     ///< numbered from 0
  std::filesystem::path script;
  std::filesystem::path folder;      ///< working folder, and where TASK.log is written
  std::vector<std::string> options;  ///< further options of sbatch
};
std::vector<std::string> submission(const Wave& wave);

/// The command that lists tasks of jobs with these names.
std::vector<std::string> listing(const std::vector<std::string>& names);

/// The output of listing(): tasks that Slurm still has, by job name and number.
using Listing = std::map<std::pair<std::string, int>, TaskState>;
Listing read_listing(const std::string& output);

}  // namespace nacre::simulator_farm
