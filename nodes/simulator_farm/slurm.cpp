#include "simulator_farm/slurm.hpp"

#include <charconv>
#include <csignal>
#include <sstream>

#include <fmt/ranges.h>

namespace nacre::simulator_farm {
namespace {

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

TaskState state_of(const std::string& state, const std::string& reason) {
  // Slurm holds tasks that it could not launch ("launch failed requeued held"), and people hold jobs.
  if (reason.find("eld") != std::string::npos) return TaskState::held;
  if (state == "RUNNING" || state == "COMPLETING" || state == "STAGE_OUT" || state == "SUSPENDED" ||
      state == "STOPPED" || state == "SIGNALING") {
    return TaskState::running;
  }
  return TaskState::waiting;
}

}  // namespace

RunningCommand::RunningCommand(const std::vector<std::string>& command, double now_s, double limit_s)
    : end_s_(now_s + limit_s) {
  try {
    process_ = std::make_unique<runtime::ChildProcess>(command);
  } catch (const InputError& error) {
    output_ = error.what();
  }
}

std::optional<runtime::ProgramOutput> RunningCommand::poll(double now_s) {
  if (!process_) return runtime::ProgramOutput{output_, {.exit_status = runtime::kProgramNotFound, .signal = 0}};
  for (const std::string& line : process_->read_lines()) output_ += line + "\n";
  if (const auto end = process_->poll_end()) {
    for (const std::string& line : process_->read_lines()) output_ += line + "\n";
    return runtime::ProgramOutput{output_, *end};
  }
  if (now_s < end_s_) return std::nullopt;
  process_->signal_group(SIGKILL);
  return runtime::ProgramOutput{output_ + "no response in time", {.exit_status = 0, .signal = SIGKILL}};
}

std::vector<std::string> submission(const Wave& wave) {
  std::vector<std::string> command = {"sbatch",
                                      "--parsable",
                                      "--requeue",
                                      "--open-mode=append",
                                      "--job-name=" + wave.name,
                                      fmt::format("--array=0-{}", wave.tasks - 1),
                                      "--chdir=" + wave.folder.string(),
                                      "--output=" + (wave.folder / (wave.name + "-%a.log")).string(),
                                      "--cpus-per-task=1"};
  command.insert(command.end(), wave.options.begin(), wave.options.end());
  command.push_back(wave.script.string());
  return command;
}

std::vector<std::string> listing(const std::vector<std::string>& names) {
  return {"squeue", "--noheader", "--array", fmt::format("--name={}", fmt::join(names, ",")), "--format=%j|%K|%T|%r"};
}

Listing read_listing(const std::string& output) {
  Listing tasks;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, number, state, reason;
    if (!std::getline(words, name, '|') || !std::getline(words, number, '|') || !std::getline(words, state, '|')) {
      continue;
    }
    std::getline(words, reason);
    if (const auto task = whole_number(number)) tasks[{name, *task}] = state_of(state, reason);
  }
  return tasks;
}

}  // namespace nacre::simulator_farm
