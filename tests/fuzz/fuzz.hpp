#pragma once
// What the fuzz targets share. A target feeds bytes that may be anything to one reader: bad input is a Result's error
// or an InputError; anything else that is thrown, every crash, every sanitizer's word and every hang is a finding.

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "base/result.hpp"

namespace nacre::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Calls a reader that throws InputError for bad input.
template <class Read>
void expect_input_errors_only(const Read& read) {
  try {
    read();
  } catch (const InputError&) {
  }
}

/// What must hold of something that was accepted.
inline void expect(bool holds) {
  if (!holds) std::abort();
}

/// A file in memory, for readers that want a path.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) : fd_(::memfd_create("fuzz", MFD_CLOEXEC)) {
    for (std::size_t written = 0; written < bytes.size();) {
      const ssize_t count = ::write(fd_, bytes.data() + written, bytes.size() - written);
      if (count <= 0) std::abort();
      written += static_cast<std::size_t>(count);
    }
  }
  ~MemoryFile() { ::close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(fd_); }

 private:
  int fd_;
};

/// A folder in memory, for readers that want one; the same for all inputs of a process.
inline const std::filesystem::path& memory_folder() {
  static const std::filesystem::path folder = [] {
    const std::filesystem::path path = "/dev/shm/nacre-fuzz-" + std::to_string(::getpid());
    std::filesystem::create_directories(path);
    std::atexit([] { std::filesystem::remove_all("/dev/shm/nacre-fuzz-" + std::to_string(::getpid())); });
    return path;
  }();
  return folder;
}

inline std::filesystem::path write_file(const std::string& name, std::string_view bytes) {
  const std::filesystem::path path = memory_folder() / name;
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  return path;
}

/// Cuts off what stands before `mark`; all of it when there is no mark.
inline std::string_view cut(std::string_view& rest, std::string_view mark) {
  const std::size_t at = rest.find(mark);
  const std::string_view part = rest.substr(0, at);
  rest.remove_prefix(at == std::string_view::npos ? rest.size() : at + mark.size());
  return part;
}

}  // namespace nacre::fuzz
