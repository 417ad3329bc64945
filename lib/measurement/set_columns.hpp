#pragma once

#include <array>
#include <string_view>

namespace nacre::measurement {

inline constexpr std::string_view kTableName = "measurements.csv";

/// Columns of measurements.csv (docs/FORMATS.md), in the order in which they are written.
enum SetColumn {
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

/// The order in which a machine made its tests: a number.
inline constexpr std::string_view kTestOrderColumn = "test_order";

/// Surroundings of a test, when it was made, of which piece, how long its strain was held, the programme of a coupon:
/// kept like any other column, but known to a diagnosis.
inline constexpr std::array<std::string_view, 7> kConditionColumns = {
    "sample", "temperature_c", "humidity_pct", "age_days", kTestOrderColumn, "hold_s", "loading"};

/// Further columns that `nacre import` writes: kept with the specimen like any other column, but known.
inline constexpr std::array<std::string_view, 11> kHistoryColumns = {"date",
                                                                     "operator",
                                                                     "machine",
                                                                     "path",
                                                                     "order_id",
                                                                     "tray",
                                                                     "peak_stress_pa",
                                                                     "failure_strain",
                                                                     "toe_strain",
                                                                     "initial_modulus_pa",
                                                                     "modulus_error_pa"};

}  // namespace nacre::measurement
