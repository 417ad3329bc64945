#include "runtime/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

#include "base/result.hpp"

namespace nacre::runtime {
namespace {

struct Pipe {
  int read_end = -1;
  int write_end = -1;
};

Pipe make_pipe() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw InputError::format("no pipe for a child process: {}", std::strerror(errno));
  return {ends[0], ends[1]};
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMayLimitMemory = false;
#elif defined(__has_feature)
constexpr bool kMayLimitMemory = !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer);
#else
constexpr bool kMayLimitMemory = true;
#endif

bool limit(int resource, std::uint64_t most) {
  const rlimit both{most, most};
  return ::setrlimit(static_cast<__rlimit_resource_t>(resource), &both) == 0;
}

/// Makes the file what the process writes to as `descriptor`; false with errno where that fails.
bool redirect(int descriptor, const std::filesystem::path& file) {
  const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  return opened >= 0 && ::dup2(opened, descriptor) == descriptor;
}

/// Limits this process; false with errno where that fails. Only async-signal-safe calls.
bool confine(const ProcessLimits& limits) {
  constexpr std::uint64_t kFiles = 256;
  return ::chdir(limits.folder.c_str()) == 0 && redirect(STDOUT_FILENO, limits.output_file) &&
         redirect(STDERR_FILENO, limits.error_file) && ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         limit(RLIMIT_CORE, 0) && limit(RLIMIT_NOFILE, kFiles) && limit(RLIMIT_FSIZE, limits.file_bytes) &&
         limit(RLIMIT_CPU, limits.processor_s) && (!kMayLimitMemory || limit(RLIMIT_AS, limits.memory_bytes));
}

struct Ends {
  int output, failure;
};

[[noreturn]] void fail_in_child(int failure) {
  const int reason = errno;
  [[maybe_unused]] const ssize_t told = ::write(failure, &reason, sizeof reason);
  ::_exit(127);
}

/// Runs in the child between fork and exec: only async-signal-safe calls. The reason of a failure goes through
/// `failure`.
[[noreturn]] void become(char* const* command, Ends ends, const ProcessLimits* limits, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);  // the parent died before the line above
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) ::signal(signal, SIG_DFL);
  const int empty_input = ::open("/dev/null", O_RDONLY);
  ::dup2(empty_input, STDIN_FILENO);
  ::dup2(ends.output, STDOUT_FILENO);
  ::dup2(ends.output, STDERR_FILENO);
  if (limits != nullptr && !confine(*limits)) fail_in_child(ends.failure);
  ::execvp(command[0], command);
  fail_in_child(ends.failure);
}

ProcessEnd end_from_wait_status(int status) {
  if (WIFSIGNALED(status)) return {.exit_status = 0, .signal = WTERMSIG(status)};
  return {.exit_status = WEXITSTATUS(status), .signal = 0};
}

}  // namespace

std::string ProcessEnd::in_words() const {
  if (signal == 0) return fmt::format("exit status {}", exit_status);
  const char* name = ::sigabbrev_np(signal);
  return name == nullptr ? fmt::format("killed by signal {}", signal) : fmt::format("killed by SIG{}", name);
}

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::optional<ProcessLimits>& limits) {
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const Pipe output = make_pipe();
  const Pipe failure = make_pipe();
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  const int fork_error = errno;
  if (pid_ == 0) become(arguments.data(), {output.write_end, failure.write_end}, limits ? &*limits : nullptr, parent);
  ::close(output.write_end);
  ::close(failure.write_end);
  output_ = output.read_end;
  int reason = pid_ < 0 ? fork_error : 0;
  if (pid_ > 0) {
    ::setpgid(pid_, pid_);  // also here: whoever comes first, the group exists before anyone signals it
    // Ends without a byte when exec succeeds, because the pipe closes on exec.
    while (::read(failure.read_end, &reason, sizeof reason) < 0 && errno == EINTR) {
    }
  }
  ::close(failure.read_end);
  if (reason == 0) {
    ::fcntl(output_, F_SETFL, O_NONBLOCK);
    return;
  }
  ::close(output_);
  if (pid_ > 0) ::waitpid(pid_, nullptr, 0);
  throw InputError::format("{}: cannot be started: {}", command.front(), std::strerror(reason));
}

ChildProcess::~ChildProcess() {
  if (!end_) {
    signal_group(SIGKILL);
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
  }
  if (output_ >= 0) ::close(output_);
}

std::vector<std::string> ChildProcess::read_lines() {
  std::vector<std::string> lines;
  char buffer[1 << 14];
  while (output_ >= 0) {
    const ssize_t count = ::read(output_, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) break;  // nothing more for now
    if (count == 0) {
      ::close(output_);
      output_ = -1;
      if (!unfinished_line_.empty()) lines.push_back(std::move(unfinished_line_));
      unfinished_line_.clear();
      break;
    }
    unfinished_line_.append(buffer, static_cast<std::size_t>(count));
    std::size_t begin = 0;
    for (std::size_t end = unfinished_line_.find('\n'); end != std::string::npos;
         end = unfinished_line_.find('\n', begin)) {
      lines.push_back(unfinished_line_.substr(begin, end - begin));
      begin = end + 1;
    }
    unfinished_line_.erase(0, begin);
  }
  return lines;
}

std::optional<ProcessEnd> ChildProcess::poll_end() {
  int status = 0;
  if (!end_ && ::waitpid(pid_, &status, WNOHANG) == pid_) end_ = end_from_wait_status(status);
  return end_;
}

void ChildProcess::signal_group(int signal) const {
  if (!end_) ::kill(-pid_, signal);
}

ProgramOutput ask_program(const std::vector<std::string>& command) try {
  ChildProcess program(command);
  ProgramOutput printed;
  while (program.output() >= 0) {
    pollfd wanted{program.output(), POLLIN, 0};
    ::poll(&wanted, 1, 1000);
    for (const std::string& line : program.read_lines()) printed.output += line + "\n";
  }
  while (!program.poll_end()) ::usleep(1000);
  printed.end = *program.poll_end();
  return printed;
} catch (const InputError&) {
  return {.output = "", .end = {.exit_status = kProgramNotFound, .signal = 0}};
}

LimitedEnd run_limited(const std::vector<std::string>& command, const ProcessLimits& limits, double patience_s) {
  using Clock = std::chrono::steady_clock;
  constexpr int kLook_us = 5000;
  ChildProcess program(command, limits);
  const auto deadline = Clock::now() + std::chrono::duration<double>(patience_s);
  LimitedEnd ended;
  std::optional<ProcessEnd> end;
  while (!(end = program.poll_end())) {
    ended.is_late = Clock::now() >= deadline;
    if (ended.is_late) program.signal_group(SIGKILL);
    ::usleep(kLook_us);
  }
  ended.end = *end;
  return ended;
}

std::filesystem::path this_program() { return std::filesystem::read_symlink("/proc/self/exe"); }

}  // namespace nacre::runtime
