#pragma once
// The files of the project, as the architecture tests read them.

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/files.hpp"

namespace nacre {

inline const std::filesystem::path kRoot = NACRE_SOURCE_DIR;

/// The files below a folder of the project with one of these extensions (".cpp"), by path relative to the root, sorted;
/// what is built, fetched or played is left out.
inline std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder,
                                                      const std::set<std::string>& extensions) {
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  if (!fs::exists(kRoot / folder)) return files;
  for (auto entry = fs::recursive_directory_iterator(kRoot / folder); entry != fs::recursive_directory_iterator();
       ++entry) {
    const fs::path file = fs::relative(entry->path(), kRoot);
    const std::string name = file.filename().string();
    const bool is_made =
        name.starts_with("build") || name == "node_modules" || name == ".git" || file.parent_path() == "logs";
    if (entry->is_directory() && is_made) entry.disable_recursion_pending();
    if (entry->is_regular_file() && extensions.contains(file.extension().string())) files.push_back(file);
  }
  std::sort(files.begin(), files.end());
  return files;
}

inline std::vector<std::filesystem::path> sources_below(const std::filesystem::path& folder) {
  return files_below(folder, {".hpp", ".cpp", ".ipp", ".inc", ".cu"});
}

inline std::string text_of(const std::filesystem::path& file) { return read_file(kRoot / file); }

}  // namespace nacre
