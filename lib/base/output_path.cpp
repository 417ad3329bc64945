#include "base/output_path.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>

#include "base/file_aside.hpp"
#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre {

namespace fs = std::filesystem;

namespace {

/// Whether the path is under a folder of the system's whose files are no files.
bool is_device(const fs::path& path) {
  const fs::path whole = fs::absolute(path).lexically_normal();
  const auto second = whole.begin() == whole.end() ? whole.end() : std::next(whole.begin());
  return second != whole.end() && (*second == "dev" || *second == "proc" || *second == "sys");
}

/// Whether `file` is the table or a curve of the measurement set in `folder`.
bool is_part_of_set(const fs::path& file, const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored) || file.extension() != ".csv") return false;
  const fs::path relative = fs::relative(file, folder, ignored);
  return !relative.empty() && *relative.begin() != "..";
}

/// Makes a file beside `file`, as write_file_atomically() does, and takes it away. The error names `shown`.
void prove_writing(const fs::path& file, const std::string& shown) {
  const fs::path aside = name_aside(file);
  const int descriptor = ::open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (descriptor < 0) throw InputError::format("{}: cannot be written: {}", shown, std::strerror(errno));
  ::close(descriptor);
  ::unlink(aside.c_str());
}

}  // namespace

void prepare_output_file(const std::string& file) {
  if (is_device(file)) throw InputError::format("{}: is no regular file, expected the name of one to write", file);
  if (const fs::path folder = fs::path(file).parent_path(); !folder.empty()) make_folder(folder.string());
  std::error_code unreadable;
  const fs::file_status status = fs::status(file, unreadable);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw InputError::format("{}: is no regular file, expected the name of one to write", file);
  prove_writing(file, file);
}

void prepare_output_file(const std::string& file, std::initializer_list<std::string> others) {
  for (const std::string& other : others) {
    if (other.empty()) continue;
    std::error_code no_such_file;
    if (fs::absolute(file).lexically_normal() == fs::absolute(other).lexically_normal() ||
        fs::equivalent(file, other, no_such_file) || is_part_of_set(file, other))
      throw InputError::format("{}: is read by the same command, expected the name of another file to write", file);
  }
  prepare_output_file(file);
}

void prepare_output_folder(const std::string& folder) {
  make_folder(folder);
  prove_writing(fs::path(folder) / "any", folder);
}

}  // namespace nacre
