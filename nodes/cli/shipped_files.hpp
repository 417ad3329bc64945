#pragma once

#include <filesystem>
#include <string>

namespace nacre::cli {

/// data/numerics_floor.toml in the working folder or above the program; `given`, when it is not empty.
std::filesystem::path numerics_floor_file(const std::string& given);

}  // namespace nacre::cli
