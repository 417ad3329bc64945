#pragma once
// Values of an enumeration and their names in files and messages.

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "base/result.hpp"

namespace nacre {

template <class Value, std::size_t count>
using NameTable = std::array<std::pair<Value, std::string_view>, count>;

/// "?" for a value that the table lacks.
template <class Value, std::size_t count>
std::string_view name_in(const NameTable<Value, count>& table, Value value) {
  for (const auto& [entry, name] : table)
    if (entry == value) return name;
  return "?";
}

/// Error: `what` 'name': expected one of the table's names.
template <class Value, std::size_t count>
Result<Value> value_in(const NameTable<Value, count>& table, std::string_view what, std::string_view name) {
  std::string known;
  for (const auto& [value, entry] : table) {
    if (entry == name) return value;
    known += (known.empty() ? "" : ", ") + std::string(entry);
  }
  return fail("{} '{}': expected one of {}", what, name, known);
}

}  // namespace nacre
