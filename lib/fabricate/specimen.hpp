#pragma once
// The outlines of what is printed: the thesis' toughness specimen and the ASTM D638 type I tensile bar.

#include <cstdint>
#include <utility>

#include "tester/names.hpp"

namespace nacre::fabricate {

enum class SpecimenKind {
  toughness,    ///< 104 x 52 mm, notched on the left at mid-length (2.2.2)
  tensile_bar,  ///< ASTM D638 type I, for Young's modulus and the tensile tests of homogeneous coupons
};

/// The specimen of a test.
SpecimenKind specimen_kind(tester::TestKind test);

/// Shape and grips of a specimen, lengths in mm. The long axis is the pulling direction.
struct SpecimenGeometry {
  std::int64_t width_um = 0;
  std::int64_t length_um = 0;
  double test_width_mm = 0.0;  ///< width that nominal stress refers to
  double gauge_mm = 0.0;       ///< length that nominal strain refers to
  double grip_mm = 0.0;        ///< length of the gripped area at either end
};
SpecimenGeometry geometry_of(SpecimenKind kind);

/// The height of the printed notch, and whether the cut is printed.
struct NotchOptions {
  double height_mm = 0.26;  ///< one pixel
  bool print_cut = false;   ///< the 60 degree cut is part of the print instead of being milled afterwards
};

/// Solid material across the specimen at `along_mm` from its upper end, as an interval from the left edge in mm; empty
/// (first >= second) where there is none.
std::pair<double, double> solid_across(SpecimenKind kind, double along_mm, const NotchOptions& notch);

/// Gauge length in mm that gives the true modulus of a homogeneous type I bar from the travel between its grips (115 mm
/// apart): the integral of 13 mm over the local width, the sections being springs in series.
double bar_effective_gauge_mm();

}  // namespace nacre::fabricate
