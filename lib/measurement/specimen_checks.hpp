#pragma once
// What a specimen record must hold to be usable, and what is implausible or suspicious in it.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurement/specimen_record.hpp"

namespace nacre::measurement {

inline constexpr std::string_view kTensileIsHomogeneous =
    "a tensile coupon is homogeneous, expected rigid, soft, interface or mix:F";

/// The result that a specimen lacks: a value of the kind that its test measures, or a curve that gives one; a tensile
/// coupon is homogeneous. Its column and what was expected. Line 0.
std::optional<RejectedRow> missing_result(const SpecimenRecord& specimen);

/// The modulus or toughness that the specimen's test measured, or that is given for it, where it lies outside
/// kModulusPa or kToughnessPa: its column and why no game can use it. Line 0.
std::optional<RejectedRow> implausible_value(const SpecimenRecord& specimen);

/// Why no game can use the specimen as a valid one: a missing result, else an implausible value. Line 0.
std::optional<RejectedRow> why_unusable(const SpecimenRecord& specimen);

/// A doubt where no mixture of the inks has such a modulus, by a factor of 20, of notched ones that of
/// `far_of_notched`; or where it would have it, were its strain in per cent. Else empty.
std::string doubt_of_modulus(const SpecimenRecord& specimen, double modulus_pa, double far_of_notched);

/// Doubts about a usable specimen that its own record raises, each as a sentence that begins with its column: units
/// that somebody forgot to convert, a value that contradicts its curve, a test that was ended too early.
std::vector<std::string> doubts_about(const SpecimenRecord& specimen);

}  // namespace nacre::measurement
