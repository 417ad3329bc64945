#pragma once
// What comes with nacre (base/shipped_files.hpp), by the words that are typed.

#include <filesystem>
#include <string>

namespace nacre::cli {

/// data/discretisation_floor.toml; `given`, when it is not empty.
std::filesystem::path discretisation_floor_file(const std::string& given);

/// A scenario as typed: a file, or the bare name of one that comes with nacre (`demo`: launch/demo.toml). Throws
/// InputError with the names for a bare name that is neither.
std::filesystem::path scenario_file(const std::filesystem::path& typed);

/// The dashboard's page: installed, or as built beside the program (build/web).
std::filesystem::path page_folder();

}  // namespace nacre::cli
