#include "measurement/specimen_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "measurement/limits.hpp"
#include "measurement/reduction.hpp"
#include "measurement/set_files.hpp"
#include "measurement/summary.hpp"

namespace nacre::measurement {
namespace {

/// Young's modulus of a mixture of the thesis' inks, roughly: straight in its logarithm up to one half, then linear.
double usual_modulus_pa(double rigid_fraction) {
  constexpr double kSoft = 1e6, kHalf = 5.6e8, kRigid = 2e9;
  if (rigid_fraction <= 0.5) return kSoft * std::pow(kHalf / kSoft, rigid_fraction / 0.5);
  return kHalf + (kRigid - kHalf) * (rigid_fraction - 0.5) / 0.5;
}

/// A modulus that no mixture of this kind has: strains in per cent make it a hundredth.
/// A notch in a set has a modulus of its own.
void collect_modulus_doubt(const SpecimenRecord& record, std::vector<std::string>& doubts) {
  constexpr double kAnyFactor = std::numeric_limits<double>::infinity();
  if (!record.design.mixture() || record.curve.size() < kFewestCurveRows || record.modulus_pa) return;
  const auto part = linear_part(record.curve);
  if (!part) return;
  if (const std::string doubt = doubt_of_modulus(record, part->slope_pa, kAnyFactor); !doubt.empty())
    doubts.push_back("column curve: " + doubt);
}

/// Doubts about a curve: units that somebody forgot to convert, and a pull that was ended too early.
void collect_curve_doubts(const SpecimenRecord& record, std::vector<std::string>& doubts) {
  constexpr double kNotSeparated = 0.2;
  if (record.curve.empty()) return;
  const auto doubt = [&](const std::string& sentence) { doubts.push_back("column curve: " + sentence); };
  const double peak_pa = std::ranges::max(record.curve.stress_pa), strain = std::ranges::max(record.curve.strain);
  if (!kUsualPeakPa.hold(peak_pa))
    doubt(fmt::format("the largest stress, {:.3g}, is unusual; is the unit Pa?", peak_pa));
  constexpr double kMostOfStiff = 1.0, kStiff = 0.3;  // a composite with that much rigid ink
  if (strain > (record.design.rigid_fraction() > kStiff ? kMostOfStiff : kMostUsualStrain))
    doubt(fmt::format("strain reaches {:.3g}, which is unusual; is it a ratio, not per cent?", strain));
  if (record.test == tester::TestKind::toughness && record.curve.stress_pa.back() > kNotSeparated * peak_pa)
    doubt(fmt::format("ends at {:.0f} % of its largest stress, expected a pull to separation",
                      100.0 * record.curve.stress_pa.back() / peak_pa));
  collect_modulus_doubt(record, doubts);
}

}  // namespace

std::string doubt_of_modulus(const SpecimenRecord& record, double modulus_pa, double far_of_notched) {
  constexpr double kFar = 20.0, kPerCent = 100.0;
  if (!record.design.mixture() || !(modulus_pa > 0.0)) return "";
  const double ratio = modulus_pa / usual_modulus_pa(record.design.rigid_fraction());
  const bool per_cent = ratio < 1.0 / kFar && ratio * kPerCent > 1.0 / kFar && ratio * kPerCent < kFar;
  const double far = record.test == tester::TestKind::toughness && !per_cent ? far_of_notched : kFar;
  if (ratio > 1.0 / far && ratio < far) return "";
  return fmt::format(
      "its modulus, {:.3g} Pa, is unusual for {}{}", modulus_pa, record.design.name(),
      per_cent ? fmt::format("; is strain in per cent, not a ratio? Then it would be {:.3g} Pa", kPerCent * modulus_pa)
               : "; are the units of strain and stress, or of extension and force, right?");
}

std::optional<RejectedRow> missing_result(const SpecimenRecord& specimen) {
  const auto lacks = [](const char* column, std::string reason) { return RejectedRow{0, column, std::move(reason)}; };
  if (!specimen.curve.empty() && specimen.curve.size() < kFewestCurveRows)
    return lacks("curve", fmt::format("has {} rows, expected at least {}", specimen.curve.size(), kFewestCurveRows));
  switch (specimen.test) {
    case tester::TestKind::modulus:
      if (modulus_of(specimen)) return std::nullopt;
      return lacks("modulus_pa",
                   "no modulus, expected modulus_pa, or a curve from below 0.05 % strain that rises to 0.25 %");
    case tester::TestKind::toughness:
      if (specimen.toughness_pa) return std::nullopt;
      if (specimen.curve.empty()) return lacks("toughness_pa", "no toughness, expected toughness_pa or a curve");
      if (tester::area_under(specimen.curve) > 0.0) return std::nullopt;
      return lacks("curve", "the area under the curve is not positive, expected a stress-strain curve to separation");
    case tester::TestKind::tensile:
      if (specimen.curve.empty()) return lacks("curve", "no curve, expected one for a tensile test");
      if (specimen.design.mixture()) return std::nullopt;
      return lacks("pattern", std::string(kTensileIsHomogeneous));
  }
  return std::nullopt;
}

std::optional<RejectedRow> implausible_value(const SpecimenRecord& specimen) {
  const auto reason = [](double value, const Limits& usual) {
    return fmt::format("{} Pa, expected {} to {}; is the unit Pa?", value, usual.least, usual.most);
  };
  // A value of the other kind is not used, whatever it is.
  switch (specimen.test) {
    case tester::TestKind::modulus: {
      const std::optional<double> modulus_pa = modulus_of(specimen);
      if (!modulus_pa || kModulusPa.hold(*modulus_pa)) return std::nullopt;
      return RejectedRow{0, "modulus_pa", reason(*modulus_pa, kModulusPa)};
    }
    case tester::TestKind::toughness: {
      const std::optional<double> toughness_pa = toughness_of(specimen);
      if (!toughness_pa || kToughnessPa.hold(*toughness_pa)) return std::nullopt;
      return RejectedRow{0, "toughness_pa", reason(*toughness_pa, kToughnessPa)};
    }
    case tester::TestKind::tensile:
      return std::nullopt;
  }
  return std::nullopt;
}

std::optional<RejectedRow> why_unusable(const SpecimenRecord& specimen) {
  auto missing = missing_result(specimen);
  return missing ? missing : implausible_value(specimen);
}

std::vector<std::string> doubts_about(const SpecimenRecord& record) {
  std::vector<std::string> doubts;
  constexpr double kAreaTolerance = 0.02;
  const bool notched = record.test == tester::TestKind::toughness;
  if (notched && record.toughness_pa && !record.curve.empty()) {
    const double area = tester::area_under(record.curve);
    if (std::abs(area - *record.toughness_pa) > kAreaTolerance * *record.toughness_pa) {
      doubts.push_back(
          fmt::format("column toughness_pa: {} differs by {:.1f} % from the area under the curve, {}; expected at "
                      "most 2 %; the given value is used",
                      *record.toughness_pa, 100.0 * std::abs(area / *record.toughness_pa - 1.0), area));
    }
  }
  const auto warn_ignored = [&](const char* column) {
    doubts.push_back(fmt::format("column {}: is not used in a {} test", column, tester::to_string(record.test)));
  };
  if (record.modulus_pa && record.test != tester::TestKind::modulus) warn_ignored("modulus_pa");
  if (record.toughness_pa && !notched) warn_ignored("toughness_pa");
  const std::optional<double> modulus = modulus_of(record);
  if (const auto doubt = implausible_value(record)) {
    doubts.push_back(fmt::format("column {}: {}", doubt->column, doubt->reason));
  } else if (record.test == tester::TestKind::modulus && modulus && *modulus > kUsualModulusPa.most) {
    doubts.push_back(fmt::format("column modulus_pa: {} Pa is unusual; is the unit Pa?", *modulus));
  }
  collect_curve_doubts(record, doubts);
  return doubts;
}

}  // namespace nacre::measurement
