#pragma once
// For modules that link tomlplusplus; base itself does not.

#include <toml++/toml.h>

#include <filesystem>

#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre {

/// The document of a TOML file. Throws InputError naming file and line.
inline toml::table read_toml_file(const std::filesystem::path& file) {
  try {
    return toml::parse(read_file(file), file.string());
  } catch (const toml::parse_error& error) {
    throw InputError::format("{}:{}: {}", file.string(), error.source().begin.line, error.description());
  }
}

}  // namespace nacre
