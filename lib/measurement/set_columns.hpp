#pragma once

#include <array>
#include <string_view>

namespace nacre::measurement {

inline constexpr std::string_view kTableName = "measurements.csv";

/// Columns of measurements.csv (docs/FORMATS.md), in the order in which they are written.
enum Column {
  kSpecimen,
  kPattern,
  kTest,
  kOrientation,
  kStrainRate,
  kBatch,
  kPrintOrder,
  kThickness,
  kModulus,
  kToughness,
  kCurve,
  kValid,
  kNote,
  kColumnCount
};

inline constexpr std::array<std::string_view, kColumnCount> kColumns = {
    "specimen", "pattern",     "test",         "orientation_deg", "strain_rate_per_s",
    "batch",    "print_order", "thickness_mm", "modulus_pa",      "toughness_pa",
    "curve",    "valid",       "note"};

}  // namespace nacre::measurement
