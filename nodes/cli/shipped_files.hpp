#pragma once

#include <filesystem>
#include <string>

namespace nacre::cli {

/// A file or folder that comes with nacre, by its name from the root: above the program, else in the working folder.
std::filesystem::path shipped_file(const std::filesystem::path& name);

/// data/discretisation_floor.toml; `given`, when it is not empty.
std::filesystem::path discretisation_floor_file(const std::string& given);

}  // namespace nacre::cli
