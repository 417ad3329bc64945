#include "runtime/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>

#include "base/no_space.hpp"

namespace nacre::runtime {
namespace {

bool is_locked_in_time(int fd) {
  constexpr int kTries = 20;
  for (int i = 0; ::flock(fd, LOCK_EX | LOCK_NB) != 0; ++i) {
    if (i == kTries) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "lock";
  fd_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (fd_ < 0) {
    const int reason = errno;
    refuse_write(fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(reason)), reason);
  }
  if (!is_locked_in_time(fd_)) {
    char owner[32] = {};
    const ssize_t length = ::read(fd_, owner, sizeof owner - 1);
    ::close(fd_);
    throw InputError::format("{}: another process (pid {}) runs this node in this run; stop it first", path.string(),
                             length > 0 ? owner : "unknown");
  }
  const std::string pid = std::to_string(::getpid());
  // The number is for people; the lock does not depend on it, and a full disk must not keep a node from saying so
  // itself.
  [[maybe_unused]] const bool noted = ::ftruncate(fd_, 0) == 0 && ::write(fd_, pid.data(), pid.size()) > 0;
}

FolderLock::~FolderLock() { ::close(fd_); }

}  // namespace nacre::runtime
