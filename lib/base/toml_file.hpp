#pragma once
// For modules that link tomlplusplus; base itself does not.

#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>

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

/// A value as a person wrote it, on one line.
inline std::string shown(const toml::node& node) {
  if (const auto number = node.value_exact<double>()) return fmt::format("{}", *number);  // TOML++ writes 17 digits
  std::ostringstream out;
  node.visit([&](const auto& value) { out << value; });
  std::string text = out.str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace nacre
