#include "base/shipped_files.hpp"

#include <string>
#include <system_error>

#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre {
namespace {

namespace fs = std::filesystem;

/// Empty: that of the program.
fs::path folder_that_was_set;

/// PREFIX/bin, or bin/ of the build; empty where /proc does not say.
fs::path program_folder() {
  if (!folder_that_was_set.empty()) return folder_that_was_set;
  std::error_code unreadable;
  return fs::read_symlink("/proc/self/exe", unreadable).parent_path();
}

}  // namespace

void set_program_folder(const fs::path& folder) { folder_that_was_set = folder; }

std::optional<fs::path> installed_folder() {
  std::error_code unreadable;
  const fs::path folder = program_folder().parent_path() / "share" / "nacre";
  return fs::is_directory(folder, unreadable) ? std::optional(folder) : std::nullopt;
}

fs::path shipped_folder() {
  if (const auto installed = installed_folder()) return *installed;
  std::error_code unreadable;
  for (fs::path folder = program_folder(); folder.has_relative_path(); folder = folder.parent_path())
    if (fs::is_directory(folder / "data" / "thesis", unreadable)) return folder;
  return ".";
}

fs::path built_folder() { return installed_folder().value_or(program_folder().parent_path()); }

std::string build_commit() try {
  const std::string text = read_file(built_folder() / "commit");
  return text.substr(0, text.find('\n'));
} catch (const InputError&) {
  return "unknown";
}

}  // namespace nacre
