#pragma once
// What no tensile test records: refused by name instead of reduced.

#include <optional>
#include <string>
#include <vector>

#include "measurement/import_fault.hpp"
#include "measurement/tester_export.hpp"

namespace nacre::measurement {

/// Row at which a series jumps by a factor of ten, a hundred or a thousand: there and back, or, with `once`, for good.
std::optional<std::size_t> decimal_jump(const std::vector<double>& values, bool once);

/// The first of: a force or an extension that does not move, jumps by powers of ten, an extension that falls while the
/// force rises. Nothing where the record is plausible.
std::optional<ImportFault> implausible_record(const TesterRecord& record, const std::string& file);

/// Doubts about the course of the force from the pull's beginning on, as sentences: it is negative on the way to its
/// peak, falls to zero at once and rises again, or stays at its largest value to the last digit.
std::vector<std::string> doubts_of_course(const std::vector<double>& stress_pa);

/// Units for columns whose headings have none: those with which modulus, peak stress and failure strain are ones of the
/// material. Of several none is taken.
struct AssumedUnits {
  double extension_factor = 1.0, force_factor = 1.0, time_factor = 1.0;
  std::vector<std::string> said;  ///< sentences
};
/// What is known with the numbers taken as they stand.
struct UnitEvidence {
  double modulus_pa = 0.0, peak_pa = 0.0, failure_strain = 0.0;
  double speed_per_s = 0.0;  ///< extension over time, mm/s; 0 without a clock
  double rigid_fraction = 0.5;
  bool is_homogeneous = false;
};
/// Error: a sentence with the remedy.
tl::expected<AssumedUnits, std::string> assumed_units(const TesterRecord& record, const UnitEvidence& evidence);

/// Whether a column was taken without a unit.
bool lacks_unit(const TesterRecord& record, Quantity quantity);

}  // namespace nacre::measurement
