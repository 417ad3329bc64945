#include "base/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "base/file_aside.hpp"
#include "base/no_space.hpp"
#include "base/result.hpp"

namespace nacre {
namespace {

/// A file descriptor that closes itself.
struct FileDescriptor {
  int fd;
  ~FileDescriptor() {
    if (fd >= 0) ::close(fd);
  }
};

/// The file that a chain of links names, existing or not; `path` itself where it is no link.
std::filesystem::path behind_links(std::filesystem::path path) {
  constexpr int kLongestChain = 40;
  std::error_code no_link;
  for (int i = 0; i < kLongestChain && std::filesystem::is_symlink(path, no_link); ++i) {
    const std::filesystem::path named = std::filesystem::read_symlink(path, no_link);
    if (no_link) break;
    path = path.parent_path() / named;  // an absolute one replaces it all
  }
  return path;
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  std::error_code unreadable;  // a name that cannot be a folder's fails to open below
  if (std::filesystem::is_directory(path, unreadable))
    throw InputError::format("{}: is a folder, expected a file", path.string());
  const FileDescriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.fd < 0) throw InputError::format("{}: cannot be read: {}", path.string(), std::strerror(errno));
  std::string bytes;
  char buffer[1 << 16];
  while (true) {
    const ssize_t count = ::read(file.fd, buffer, sizeof buffer);
    if (count < 0) throw InputError::format("{}: cannot be read: {}", path.string(), std::strerror(errno));
    if (count == 0) return bytes;
    bytes.append(buffer, static_cast<std::size_t>(count));
  }
}

std::string read_file_up_to(const std::filesystem::path& path, std::size_t most_bytes) {
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status(path, failure);
  if (!std::filesystem::exists(status)) throw InputError::format("{}: there is no such file", path.string());
  if (!std::filesystem::is_regular_file(status)) {
    throw InputError::format("{}: expected a regular file", path.string());
  }
  const std::uintmax_t size = std::filesystem::file_size(path, failure);
  if (failure) throw InputError::format("{}: cannot be read: {}", path.string(), failure.message());
  if (size > most_bytes) {
    throw InputError::format("{}: has {} bytes, expected at most {}", path.string(), size, most_bytes);
  }
  return read_file(path);
}

std::filesystem::path without_last_slash(const std::filesystem::path& path) {
  return path.has_filename() ? path : path.parent_path();
}

std::string shell_word(const std::filesystem::path& path) {
  const std::string text = path.string();
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,.@%/";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string word = "'";
  for (const char letter : text) word += letter == '\'' ? std::string(R"('\'')") : std::string(1, letter);
  return word + "'";
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem) refuse_write(fmt::format("{}: cannot be made: {}", folder.string(), problem.message()), problem.value());
}

std::filesystem::path name_aside(const std::filesystem::path& path) {
  static std::atomic<unsigned> names = 0;
  char host[65] = "unknown";
  ::gethostname(host, sizeof host - 1);
  return fmt::format("{}.{}-{}-{}.part", path.string(), host, ::getpid(), ++names);
}

void sync_folder(const std::filesystem::path& folder) {
  const FileDescriptor entry{::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (entry.fd >= 0) ::fsync(entry.fd);
}

FileAside::FileAside(const std::filesystem::path& link_or_file)
    : path_(behind_links(link_or_file)), aside_(name_aside(path_)) {
  fd_ = ::open(aside_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd_ < 0) give_up(errno);
  struct stat replaced {};
  if (::stat(path_.c_str(), &replaced) == 0) ::fchmod(fd_, replaced.st_mode & 07777);  // who may read it stays
}

FileAside::~FileAside() {
  if (fd_ < 0) return;
  ::close(fd_);
  ::unlink(aside_.c_str());
}

void FileAside::give_up(int reason) const {
  ::unlink(aside_.c_str());
  refuse_write(fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(reason)), reason);
}

void FileAside::append(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(fd_, bytes.data(), bytes.size());
    if (count < 0) give_up(errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void FileAside::keep() {
  if (::fsync(fd_) != 0) give_up(errno);
  ::close(std::exchange(fd_, -1));
  if (::rename(aside_.c_str(), path_.c_str()) != 0) give_up(errno);
  sync_folder(path_.has_parent_path() ? path_.parent_path() : ".");
}

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
  FileAside file(path);
  file.append(bytes);
  file.keep();
}

}  // namespace nacre
