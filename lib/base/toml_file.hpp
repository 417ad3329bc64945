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

/// A place in a file: `demo.toml:12:5`, file, line and column.
inline std::string place(std::string_view source, const toml::source_region& region) {
  return fmt::format("{}:{}:{}", source, region.begin.line, region.begin.column);
}

inline std::string place(std::string_view source, const toml::node& node) { return place(source, node.source()); }

/// A TOML document from text. Throws InputError naming the place.
inline toml::table read_toml(std::string_view text, std::string_view source) {
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& error) {
    throw InputError::format("{}: not TOML: {}", place(source, error.source()), error.description());
  }
}

/// The document of a TOML file. Throws InputError naming file, line and column.
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
