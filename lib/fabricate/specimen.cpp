#include "fabricate/specimen.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "thesis/constants.hpp"

namespace nacre::fabricate {
namespace {

constexpr double kMm = 1e3;      // per metre
constexpr double kUmPerM = 1e6;  // per metre

// ASTM D638, type I, mm: overall 165 x 19, narrow section 57 x 13, fillets of radius 76, gauge 50, grips 115 apart.
constexpr double kBarLength = 165.0, kBarWidth = 19.0, kNarrowLength = 57.0, kNarrowWidth = 13.0;
constexpr double kFilletRadius = 76.0, kBarGauge = 50.0, kGripDistance = 115.0;

constexpr std::int64_t to_um(double metres) { return static_cast<std::int64_t>(metres * kUmPerM + 0.5); }

/// Half the width of the bar at a distance from its middle.
double bar_half_width(double from_middle_mm) {
  const double beyond = std::abs(from_middle_mm) - kNarrowLength / 2;
  if (beyond <= 0.0) return kNarrowWidth / 2;
  if (beyond >= kFilletRadius) return kBarWidth / 2;
  const double sagitta = kFilletRadius - std::sqrt(kFilletRadius * kFilletRadius - beyond * beyond);
  return std::min(kNarrowWidth / 2 + sagitta, kBarWidth / 2);
}

/// Depth of void from the left edge of the toughness specimen, at a distance from the notch's axis.
double notch_depth(double from_axis_mm, const NotchOptions& notch) {
  double depth = std::abs(from_axis_mm) < notch.height_mm / 2 ? thesis::kNotchLength * kMm : 0.0;
  if (notch.print_cut) {
    const double half_angle = 0.5 * thesis::kCutAngle * std::numbers::pi / 180.0;
    depth = std::max(depth, thesis::kCutDepth * kMm - std::abs(from_axis_mm) / std::tan(half_angle));
  }
  return depth;
}

}  // namespace

SpecimenKind specimen_kind(tester::TestKind test) {
  return test == tester::TestKind::toughness ? SpecimenKind::toughness : SpecimenKind::tensile_bar;
}

SpecimenGeometry geometry_of(SpecimenKind kind) {
  SpecimenGeometry geometry;
  if (kind == SpecimenKind::toughness) {
    geometry.width_um = to_um(thesis::kSpecimenWidth);
    geometry.length_um = to_um(thesis::kSpecimenLength);
    geometry.test_width_mm = thesis::kSpecimenWidth * kMm;
    geometry.gauge_mm = thesis::kGaugeLength * kMm;
    geometry.grip_mm = (thesis::kSpecimenLength - thesis::kGaugeLength) / 2 * kMm;
  } else {
    geometry.width_um = to_um(kBarWidth / kMm);
    geometry.length_um = to_um(kBarLength / kMm);
    geometry.test_width_mm = kNarrowWidth;
    geometry.gauge_mm = kBarGauge;
    geometry.grip_mm = (kBarLength - kGripDistance) / 2;
  }
  return geometry;
}

std::pair<double, double> solid_across(SpecimenKind kind, double along_mm, const NotchOptions& notch) {
  if (kind == SpecimenKind::tensile_bar) {
    const double half = bar_half_width(along_mm - kBarLength / 2);
    return {kBarWidth / 2 - half, kBarWidth / 2 + half};
  }
  const double middle_mm = thesis::kSpecimenLength / 2 * kMm;
  return {notch_depth(along_mm - middle_mm, notch), thesis::kSpecimenWidth * kMm};
}

double bar_effective_gauge_mm() {
  constexpr int kSteps = 11500;
  const double step = kGripDistance / kSteps;
  double length = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    length += step * kNarrowWidth / (2.0 * bar_half_width((i + 0.5) * step - kGripDistance / 2));
  }
  return length;
}

}  // namespace nacre::fabricate
