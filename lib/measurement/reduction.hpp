#pragma once
// From force and travel to the properties of a specimen (thesis 2.2.2; ASTM D638, 11 and Annex A1).

#include <optional>
#include <vector>

#include "base/result.hpp"
#include "tester/curve.hpp"

namespace nacre::measurement {

/// What is done with the first part of a curve, in which slack and seating give way.
enum class Toe {
  compensate,  ///< strain counts from where the extended linear part meets zero stress (D638 A1)
  keep,
};

/// The part of a curve along which strain grows beyond what was reached before: what area_between() can compare.
/// Snap-back and unloading are left out.
tester::Curve forward_part(const tester::Curve& curve);

/// The initial straight part of a curve.
struct LinearPart {
  double slope_pa = 0.0;     ///< Young's modulus by D638 11.4: stress over strain along it
  double zero_strain = 0.0;  ///< where it meets zero stress
  std::size_t first = 0;     ///< index of the curve where it begins
  std::size_t last = 0;      ///< and ends, included
};

/// Finds the initial linear part on the way to the peak: windows of a fifth of the peak stress between 0 and 80 % of it
/// slide along the part of the curve that is loaded for the first time; the steepest is taken together with its
/// neighbours that are at least 98 % as steep, and a line is fitted to all of their points. Error: the stress does not
/// rise, or there are fewer than three points on the way.
Result<LinearPart> linear_part(const tester::Curve& curve);

/// A test reduced to what nacre uses.
struct ReducedTest {
  tester::Curve curve;  ///< nominal; all cycles kept; to separation when the specimen separated
  double modulus_pa = 0.0;
  double toe_strain = 0.0;  ///< what compensation took off; 0 when the toe is kept
  double peak_stress_pa = 0.0;
  double failure_strain = 0.0;  ///< at separation, else the largest of the record
  double toughness_pa = 0.0;    ///< area under the curve (Eq. 2.6)
  bool separated = false;       ///< the stress fell to 2 % of its peak and stayed there, the strain did not go back
  bool unloaded = false;        ///< the strain went back with the stress: the specimen is whole
  double residual_share = 0.0;  ///< stress at the end of the record over the peak
};

/// `curve`: nominal stress over nominal strain as recorded, at least five points. Error as of linear_part().
Result<ReducedTest> reduce(const tester::Curve& curve, Toe toe);

/// Median of |d strain / d t| where time goes on, 1/s; nothing without time.
std::optional<double> strain_rate(const std::vector<double>& time_s, const std::vector<double>& strain);

}  // namespace nacre::measurement
