#include "program.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>

#include <gtest/gtest.h>

#include "../instrumented.hpp"
#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

Clock::time_point deadline(double timeout_s) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout_s));
}

void read_output(runtime::ChildProcess& process, std::string& said) {
  pollfd wanted{process.output(), POLLIN, 0};
  ::poll(&wanted, wanted.fd >= 0 ? 1 : 0, 20);
  for (const std::string& line : process.read_lines()) said += line + "\n";
}

/// Where this process keeps its files, gone with it when all went well. Process numbers would not do: every isolated
/// test is number 1 of its own namespace, and all of them share the disk.
class TestFolder {
 public:
  TestFolder() {
    std::string name = testing::TempDir() + "nacre_XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) throw InputError::format("{}: cannot be made", name);
    path_ = name;
  }
  ~TestFolder() {
    if (testing::UnitTest::GetInstance()->Failed()) return;
    std::error_code left_behind;
    fs::remove_all(path_, left_behind);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

const fs::path& test_folder() {
  static const TestFolder folder;
  return folder.path();
}

/// A process' command line; nothing of one that ends meanwhile (its file opens and then cannot be read).
std::string command_line(const fs::path& process) {
  try {
    return read_file(process / "cmdline");
  } catch (const InputError&) {
    return "";
  }
}

}  // namespace

fs::path fresh_folder(const std::string& name) {
  const fs::path folder = test_folder() / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

std::string program(const std::string& name) { return std::string(NACRE_BINARY_DIR) + "/" + name; }

Outcome run_nacre(const std::vector<std::string>& arguments, double timeout_s) {
  static int counter = 0;
  const fs::path errors = test_folder() / ("standard_error_" + std::to_string(++counter));
  std::vector<std::string> command = {"/bin/sh", "-c", "exec 2>\"$0\"; exec \"$@\"", errors.string(), program("nacre")};
  command.insert(command.end(), arguments.begin(), arguments.end());
  Outcome outcome;
  runtime::ChildProcess process(command);
  runtime::ProcessEnd end = wait_for_end(process, outcome.out, timeout_s);
  if (end.signal == SIGALRM) end.signal = SIGKILL;  // the destructor does it
  outcome.status = end.signal != 0 ? 128 + end.signal : end.exit_status;
  outcome.err = read_file(errors);
  fs::remove(errors);
  return outcome;
}

bool wait_until_said(runtime::ChildProcess& process, const std::string& text, std::string& said, double timeout_s) {
  const auto end = deadline(timeout_s);
  while (said.find(text) == std::string::npos) {
    if (Clock::now() > end || process.output() < 0) return false;
    read_output(process, said);
  }
  return true;
}

runtime::ProcessEnd wait_for_end(runtime::ChildProcess& process, std::string& said, double timeout_s) {
  const auto end = deadline(test::kPatience * timeout_s);
  while (Clock::now() < end) {
    read_output(process, said);
    if (const auto how = process.poll_end()) {
      read_output(process, said);
      return *how;
    }
  }
  return {.exit_status = 0, .signal = SIGALRM};
}

std::vector<int> processes_with(const std::string& text) {
  std::vector<int> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (!std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; })) continue;
    if (std::stoi(name) == ::getpid()) continue;
    std::string command = command_line(entry.path());
    std::replace(command.begin(), command.end(), '\0', ' ');
    if (command.find(text) != std::string::npos) found.push_back(std::stoi(name));
  }
  return found;
}

bool becomes_true(const std::function<bool()>& condition, double timeout_s) {
  const auto end = deadline(test::kPatience * timeout_s);
  while (!condition()) {
    if (Clock::now() > end) return false;
    ::usleep(20'000);
  }
  return true;
}

}  // namespace nacre
