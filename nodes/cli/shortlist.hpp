#pragma once
// A shortlist, as the dashboard saves it: CSV with a column `design`.

#include <filesystem>
#include <vector>

#include "pattern/design.hpp"

namespace nacre::cli {

/// The designs in the order of the file, each once. Throws InputError naming file, line and what was expected.
std::vector<pattern::Design> read_shortlist(const std::filesystem::path& file);

}  // namespace nacre::cli
