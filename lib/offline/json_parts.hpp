#pragma once
// Parts that several JSON documents have in common (docs/FORMATS.md, "JSON documents").

#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "measurement/specimen_record.hpp"

namespace nacre::offline {

/// The value, or null.
template <class T>
nlohmann::ordered_json or_null(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

/// A row that could not be used as {line, column, reason}, and all of a set.
nlohmann::ordered_json row_json(const measurement::RejectedRow& row);
nlohmann::ordered_json rejected_json(const std::vector<measurement::RejectedRow>& rejected);

}  // namespace nacre::offline
