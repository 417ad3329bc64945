#pragma once
// Parts of the page's JSON that several views share (docs/FORMATS.md, "Dashboard"). SI units.

#include <optional>

#include <nlohmann/json.hpp>

#include "wire/convert.hpp"

namespace nacre::dashboard {

using Json = nlohmann::ordered_json;

/// A value, or null where there is none.
template <typename Value>
Json json_or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// Strains and stresses as two arrays, at most 400 points; null for an empty curve.
Json curve_json(const tester::Curve& curve);

/// Prediction errors of one model on one set of designs; null when nothing was compared.
Json errors_json(const sysid::PredictionErrors& errors);

}  // namespace nacre::dashboard
