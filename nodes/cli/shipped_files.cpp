#include "shipped_files.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

#include <fmt/ranges.h>

#include "base/result.hpp"
#include "base/shipped_files.hpp"

namespace nacre::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_of_scenarios() {
  std::vector<std::string> names;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(shipped_folder() / "launch", unreadable))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

}  // namespace

fs::path discretisation_floor_file(const std::string& given) {
  return given.empty() ? shipped_folder() / "data" / "discretisation_floor.toml" : fs::path(given);
}

fs::path scenario_file(const fs::path& typed) {
  std::error_code unreadable;
  if (typed.has_parent_path() || typed.has_extension() || fs::exists(typed, unreadable)) return typed;
  const std::vector<std::string> names = names_of_scenarios();
  if (std::ranges::count(names, typed.string()) > 0)
    return shipped_folder() / "launch" / fmt::format("{}.toml", typed.string());
  throw InputError::format("{}: no such scenario: expected a file{}{}", typed.string(),
                           names.empty() ? "" : " or one of ", fmt::join(names, ", "));
}

fs::path page_folder() { return built_folder() / "web"; }

}  // namespace nacre::cli
