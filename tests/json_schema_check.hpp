#pragma once
// JSON against a JSON Schema, as far as nacre's schemas go: type, properties, required, items, minItems, maxItems,
// enum, minimum, maximum. A keyword that is none of these, and a member that the schema does not know, is a fault.

#include <algorithm>
#include <set>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace nacre {

inline bool has_type(const nlohmann::ordered_json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  return type == "number" && value.is_number();
}

/// What of `value` contradicts `schema`, with its place; empty: nothing does.
inline std::string schema_fault(const nlohmann::ordered_json& schema, const nlohmann::ordered_json& value,
                                const std::string& place = "") {
  static const std::set<std::string> kKnown = {"$schema",  "title",    "type", "properties", "required", "items",
                                               "minItems", "maxItems", "enum", "minimum",    "maximum"};
  for (const auto& [keyword, argument] : schema.items())
    if (!kKnown.contains(keyword)) return fmt::format("{}: keyword {}", place, keyword);
  if (!has_type(value, schema.at("type")))
    return fmt::format("{}: {} is no {}", place, value.dump(), schema["type"].dump());
  if (value.is_object()) {
    for (const auto& name : schema.at("required"))
      if (!value.contains(name.get<std::string>())) return fmt::format("{}: {} is missing", place, name.dump());
    for (const auto& [name, member] : value.items()) {
      if (!schema.at("properties").contains(name)) return fmt::format("{}: {} is not in the schema", place, name);
      const std::string fault = schema_fault(schema["properties"][name], member, place + "/" + name);
      if (!fault.empty()) return fault;
    }
  }
  if (value.is_array()) {
    if (value.size() < schema.value("minItems", std::size_t{0}) ||
        value.size() > schema.value("maxItems", std::size_t{1} << 32))
      return fmt::format("{}: {} elements", place, value.size());
    for (const auto& element : value)
      if (const std::string fault = schema_fault(schema.at("items"), element, place + "[]"); !fault.empty())
        return fault;
  }
  if (schema.contains("enum") && std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
    return fmt::format("{}: {} is no choice", place, value.dump());
  if (schema.contains("minimum") && value < schema["minimum"])
    return fmt::format("{}: {} is too small", place, value.dump());
  if (schema.contains("maximum") && value > schema["maximum"])
    return fmt::format("{}: {} is too large", place, value.dump());
  return {};
}

}  // namespace nacre
