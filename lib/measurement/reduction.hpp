#pragma once
// From force and travel to the properties of a specimen (thesis 2.2.2; ASTM D638, 11 and Annex A1).

#include "base/result.hpp"
#include "tester/curve.hpp"

namespace nacre::measurement {

/// Treatment of the toe of a curve, in which slack is taken up and the specimen seats.
enum class Toe {
  compensate,  ///< strain counts from where the extended linear part meets zero stress (D638 A1), if within kLargestToe
  keep,
};

inline constexpr double kLargestToe = 0.01;   ///< strain; a later start may be a soft material that stiffens
inline constexpr double kSureModulus = 0.01;  ///< standard error over modulus up to which a modulus is not doubted

/// The part of a curve along which strain exceeds its earlier values, as area_between() needs it.
/// Snap-back and unloading are left out.
tester::Curve forward_part(const tester::Curve& curve);

/// The initial straight part of a curve.
struct LinearPart {
  double slope_pa = 0.0;        ///< Young's modulus by D638 11.4: stress over strain along it
  double slope_error_pa = 0.0;  ///< its standard error, from the residuals
  double zero_strain = 0.0;     ///< where it meets zero stress
  std::size_t first = 0;        ///< index of the curve where it begins
  std::size_t last = 0;         ///< and ends, included
};

/// Finds the initial linear part before the peak, on first loading. A window spans a
/// fifth of the peak stress or 2 % strain, whichever is shorter, and is made longer (to 80 % of the peak) until the
/// standard error of its slope is 1 %. The first whose second half is at most 1 % steeper than its first, but for a
/// standard error, lies beyond the toe; it is made longer as long as its halves agree. Not the steepest: that would be
/// noise, or the stiffening of a soft material before it breaks. Error: the stress does not rise, or there are fewer
/// than three points on the way.
Result<LinearPart> linear_part(const tester::Curve& curve);

/// The properties and the curve of a test.
struct ReducedTest {
  tester::Curve curve;  ///< nominal; all cycles kept; to separation when the specimen separated
  double modulus_pa = 0.0, modulus_error_pa = 0.0;      ///< with its standard error
  double straight_from_pa = 0.0, straight_to_pa = 0.0;  ///< stresses between which the straight part lies
  double toe_strain = 0.0;                              ///< toe that was compensated; 0 when it is kept
  double toe_kept = 0.0;                                ///< toe that was not compensated, beyond kLargestToe
  double peak_stress_pa = 0.0;
  double stiffening = 0.0;      ///< peak stress over modulus times its strain: below 1 for materials that yield
  double failure_strain = 0.0;  ///< at separation, else the largest of the record
  double toughness_pa = 0.0;    ///< area under the curve (Eq. 2.6)
  bool separated = false;       ///< the stress fell to 2 % of its peak and stayed there, the strain did not return
  bool unloaded = false;        ///< the strain returned with the stress: the specimen is intact
  double residual_share = 0.0;  ///< stress at the end of the record over the peak
};

/// `curve`: nominal stress over nominal strain as recorded, at least five points. Error as of linear_part().
Result<ReducedTest> reduce(const tester::Curve& curve, Toe toe);

}  // namespace nacre::measurement
