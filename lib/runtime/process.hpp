#pragma once
// Child processes of the launcher: each in a process group of its own, output through a pipe, never outliving its
// parent.

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nacre::runtime {

/// How a process ended.
struct ProcessEnd {
  int exit_status = 0;  ///< of a process that exited by itself
  int signal = 0;       ///< that killed it, 0 when none did
  bool orderly() const { return signal == 0 && exit_status == 0; }
  std::string in_words() const;  ///< "exit status 2", "killed by SIGSEGV"
};

/// A running child. Standard input is empty, standard output and standard error come through one pipe. The kernel kills
/// the child when the thread that started it ends, so that nothing is left behind even when the launcher itself is
/// killed; start children from a thread that lives as long as they should.
class ChildProcess {
 public:
  /// Starts `command` (program path first). Throws InputError when the program cannot be started.
  explicit ChildProcess(const std::vector<std::string>& command);
  /// Kills the process group, when it still runs, and reaps the child.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return pid_; }
  /// Readable end of the output pipe (non-blocking), for poll(); -1 after the end of the output.
  int output() const { return output_; }
  /// Complete lines that have arrived, without line ends; an unfinished last line once the output has ended.
  std::vector<std::string> read_lines();
  /// How it ended; nothing while it runs. Reaps the child.
  std::optional<ProcessEnd> poll_end();
  /// Sends `signal` to the whole process group; harmless after the end.
  void signal_group(int signal) const;

 private:
  pid_t pid_ = -1;
  int output_ = -1;
  std::string unfinished_line_;
  std::optional<ProcessEnd> end_;
};

/// Exit status of a program that could not be started, as shells have it.
constexpr int kProgramNotFound = 127;

/// What a short-lived program printed, and how it ended; for what other programs know (git).
struct ProgramOutput {
  std::string output;
  ProcessEnd end;
};
ProgramOutput ask_program(const std::vector<std::string>& command);

/// Full path of this program's executable file.
std::filesystem::path this_program();

}  // namespace nacre::runtime
