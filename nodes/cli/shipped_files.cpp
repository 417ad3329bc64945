#include "shipped_files.hpp"

#include <system_error>

namespace nacre::cli {

std::filesystem::path shipped_file(const std::filesystem::path& name) {
  std::error_code unreadable;
  std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", unreadable);
  while (folder.has_parent_path() && folder != folder.root_path()) {
    folder = folder.parent_path();
    if (std::filesystem::exists(folder / name, unreadable)) return folder / name;
  }
  return name;
}

std::filesystem::path discretisation_floor_file(const std::string& given) {
  return given.empty() ? shipped_file("data/discretisation_floor.toml") : std::filesystem::path(given);
}

}  // namespace nacre::cli
