#pragma once
// For modules that link tomlplusplus; base itself does not.

#include <toml++/toml.h>

#include <filesystem>

#include "base/files.hpp"
#include "base/result.hpp"

namespace nacre {

/// A TOML document from text. Throws InputError naming `source` and line.
inline toml::table read_toml(std::string_view text, const std::string& source) {
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& error) {
    throw InputError::format("{}:{}: {}", source, error.source().begin.line, error.description());
  }
}

/// The document of a TOML file. Throws InputError naming file and line.
inline toml::table read_toml_file(const std::filesystem::path& file) {
  return read_toml(read_file(file), file.string());
}

}  // namespace nacre
