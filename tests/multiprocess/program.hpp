#pragma once
// Running real programs from tests.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "runtime/process.hpp"

namespace nacre {

/// A folder for one test, new and empty.
std::filesystem::path fresh_folder(const std::string& name);

/// What a program said and how it ended.
struct Outcome {
  int status = 0;  ///< exit status; 128 + signal when one killed it
  std::string out;
  std::string err;
};

/// build/bin/nacre with these arguments, until it ends; killed with status 137 after timeout_s (here and
/// below: ten times as long in instrumented builds).
Outcome run_nacre(const std::vector<std::string>& arguments, double timeout_s = 60.0);

/// build/bin/NAME
std::string program(const std::string& name);

/// Reads the output of a started program until `text` has been said; false when it ends or timeout_s is over first.
/// What was said is appended to `said`.
bool wait_until_said(runtime::ChildProcess& process, const std::string& text, std::string& said,
                     double timeout_s = 30.0);

/// How a started program ends; signal SIGALRM when it is still running after timeout_s. Output goes to `said`.
runtime::ProcessEnd wait_for_end(runtime::ChildProcess& process, std::string& said, double timeout_s = 60.0);

/// Numbers of processes other than this one whose command line contains `text`.
std::vector<int> processes_with(const std::string& text);

/// Whether `condition` becomes true within timeout_s.
bool becomes_true(const std::function<bool()>& condition, double timeout_s);

}  // namespace nacre
