#pragma once
// Child processes of the launcher: each in a process group of its own, output through a pipe, never outliving its
// parent.

#include <sys/types.h>

#include <cstdint>
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

/// What a child may use that handles what strangers made. Beyond memory it gets none, beyond a file's size or its time
/// on the processor it is killed.
struct ProcessLimits {
  std::filesystem::path folder;       ///< that it works in
  std::filesystem::path output_file;  ///< for its standard output
  std::filesystem::path error_file;   ///< for its standard error
  std::uint64_t memory_bytes = 0;     ///< of addresses; not limited in builds with sanitizers, which reserve terabytes
  std::uint64_t file_bytes = 0;       ///< of each file that it writes
  unsigned processor_s = 0;
};

/// A running child. Standard input is empty, standard output and standard error come through one pipe. The kernel kills
/// the child when the thread that started it ends, so that nothing is left behind even when the launcher itself is
/// killed; start children from a thread that lives as long as they should.
class ChildProcess {
 public:
  /// Starts `command` (program path first). Throws InputError when the program cannot be started.
  explicit ChildProcess(const std::vector<std::string>& command,
                        const std::optional<ProcessLimits>& limits = std::nullopt);
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

/// How a limited program ended.
struct LimitedEnd {
  ProcessEnd end;
  bool is_late = false;  ///< it was killed after `patience_s`
};
/// Waits for a program within limits, with everything that it started. Throws InputError when it cannot be started.
LimitedEnd run_limited(const std::vector<std::string>& command, const ProcessLimits& limits, double patience_s);

/// Full path of this program's executable file.
std::filesystem::path this_program();

}  // namespace nacre::runtime
