#pragma once
// Feasible ranges of the parameters of the two testers: the thesis' Tables A.1 and A.2, or those of other inks.

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "material/parameters.hpp"

namespace nacre::material {

/// Feasible range of one parameter. Ranges that span over a decade are searched in log10.
struct ParameterRange {
  std::string_view name;
  double minimum = 0.0;
  double maximum = 0.0;
  bool logarithmic() const { return maximum > 10.0 * minimum && minimum > 0.0; }
  double clamped(double value) const { return std::clamp(value, minimum, maximum); }
  bool operator==(const ParameterRange&) const = default;
};

/// Point of the unit interval <-> value of a parameter, log10 where range.logarithmic().
double to_unit(const ParameterRange& range, double value);
double from_unit(const ParameterRange& range, double unit);

/// The purpose of a range: base materials one by one (Table A.1), or microstructures (Table A.2).
enum class FitTarget { base, microstructures };

/// A range for every parameter of theta and eta, in the order of their vectors.
struct ParameterRanges {
  std::array<ParameterRange, kModulusParameterCount> base_modulus, microstructure_modulus;
  std::array<ParameterRange, kToughnessParameterCount> base_toughness, microstructure_toughness;
  std::span<const ParameterRange> modulus(FitTarget target) const;
  std::span<const ParameterRange> toughness(FitTarget target) const;
  bool operator==(const ParameterRanges&) const = default;
};

/// Tables A.1 and A.2 (the content of data/thesis/parameter_ranges.csv), for TangoBlackPlus and VeroWhitePlus.
const ParameterRanges& thesis_ranges();

/// The same with the ranges of W for the base model's criterion (material/criterion_strengths.hpp).
const ParameterRanges& default_ranges();

/// `set` with every parameter outside its range for microstructures replaced by the middle of that range: the initial
/// guess for other inks, of which only the ranges are known.
ParameterSet brought_inside(const ParameterSet& set, const ParameterRanges& ranges);

/// Ranges for other inks, CSV: `tester` (modulus, toughness), `fitted_to` (base, microstructures), `parameter`,
/// `minimum`, `maximum` (SI units, above 0, minimum below maximum, nu at most 0.5), each range once; those that are
/// absent are those of `otherwise`. Throws InputError naming file, line, column.
ParameterRanges read_ranges(const std::filesystem::path& path, const ParameterRanges& otherwise = thesis_ranges());
ParameterRanges parse_ranges(std::string_view text, const std::string& source,
                             const ParameterRanges& otherwise = thesis_ranges());
/// All ranges as such a table; parse_ranges() reads them back to the bit.
std::string to_csv(const ParameterRanges& ranges);

}  // namespace nacre::material
