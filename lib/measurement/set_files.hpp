#pragma once
// The files that a measurement set names: where they may be, and the curve format.

#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "tester/curve.hpp"

namespace nacre::measurement {

/// Bounds on what a set may hold.
inline constexpr std::size_t kMostTableBytes = 64u << 20;
inline constexpr std::size_t kMostTableRows = 100'000;
inline constexpr std::size_t kMostCurveBytes = 64u << 20;
inline constexpr std::size_t kMostCurveRows = 1'000'000;
inline constexpr std::size_t kMostSetPoints = 20'000'000;
inline constexpr std::size_t kFewestCurveRows = 5;
inline constexpr std::size_t kMostLayoutBytes = 4096;

/// The file `name` of the set in `folder`. Error when the name is absolute, climbs with `..`, or leads outside the
/// folder through a link.
Result<std::filesystem::path> file_inside(const std::filesystem::path& folder, std::string_view name);

/// Reads a curve: CSV with the columns `strain` and `stress_pa` (others are ignored), 5 to 1e6 rows of finite numbers,
/// strain above -1, nominal. Errors name `shown_name`, line and column.
Result<tester::Curve> read_curve(const std::filesystem::path& path, const std::string& shown_name);

/// The same from text.
Result<tester::Curve> curve_from_csv(std::string_view text, const std::string& shown_name);

/// The same format as text, numbers written so that reading gives the same bits.
std::string to_csv(const tester::Curve& curve);

}  // namespace nacre::measurement
