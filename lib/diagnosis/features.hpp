#pragma once
// Features that a diagnosis compares: numbers that summarise a test, each smooth in the parameters and with a meaning
// of its own.

#include <array>
#include <optional>
#include <string_view>

#include "base/result.hpp"
#include "diagnosis/procedure.hpp"
#include "measurement/pauses.hpp"
#include "tester/curve.hpp"

namespace nacre::diagnosis {

/// Stresses and moduli as natural logarithms (of Pa), strains as they are; peak: the largest stress.
enum class Feature {
  log_modulus,      ///< Young's modulus, modulus test
  log_toughness,    ///< area under the curve
  toe_strain,       ///< where the line through 20 and 40 % of the peak meets zero stress (notched specimens)
  log_tangent_10,   ///< slope between 5 and 15 % of the peak
  log_tangent_30,   ///< between 20 and 40 %
  log_tangent_50,   ///< between 40 and 60 %
  knee,             ///< log of the energy up to the peak over that of a triangle: above 0 the curve bends over
  log_peak,         ///< peak stress
  log_peak_strain,  ///< strain at the peak, log
  drop,             ///< how much farther the strain goes until half the peak: log(0.05 + strain over peak strain)
  tail,             ///< share of the energy behind the peak
  log_unloading,    ///< slope of the first unloading, between 90 and 50 % of the stress where it begins, or as far as
                    ///< it goes where that is to 80 % at least
  set_share,        ///< where that line meets zero stress, over the strain where unloading begins
  toe_share,    ///< toe_strain over the strain at 30 % of the peak (coupons: some are pulled a hundred times as far as
                ///< others)
  log_held,     ///< stress at the end of a hold over the one at its beginning
  held_set,     ///< strain at zero force over that of the turn, of coupons that were unloaded so far
  dwelled_set,  ///< the same after a dwell
};
inline constexpr int kFeatureCount = 17;

/// Name in files: `log_peak`.
std::string_view to_string(Feature feature);
/// For a person: "stress at the peak".
std::string_view in_words(Feature feature);
/// Whether a feature of a curve is the logarithm of something that grows as all its stresses grow.
bool is_curve_stress(Feature feature);
Result<Feature> feature_from_string(std::string_view name);

/// One value per feature, in their order; empty where the test does not show it.
using FeatureValues = std::array<std::optional<double>, kFeatureCount>;
inline std::optional<double>& value_of(FeatureValues& values, Feature feature) {
  return values[static_cast<std::size_t>(feature)];
}
inline const std::optional<double>& value_of(const FeatureValues& values, Feature feature) {
  return values[static_cast<std::size_t>(feature)];
}

/// Features of a notched specimen pulled to separation. The curve is taken at 128 points first, so that measured and
/// simulated curves are read in the same way. All empty when the stress never rises.
FeatureValues fracture_features(const tester::Curve& curve, const CurveReading& reading);

/// Features of an unnotched coupon that need not break: tangents relative to the largest stress, that stress, toe, knee
/// (over all of the curve: a plateau behind the peak bends it too), and of the first unloading where there is one. Its
/// strain is not among them: it is where the test was stopped. Readings that scatter are smoothed first
/// (smoothing.hpp). `up_to`: strain to which the way up is read, of coupons that were unloaded at strains of their own.
FeatureValues tensile_features(const tester::Curve& curve, const CurveReading& reading,
                               std::optional<double> up_to = std::nullopt);

/// Adds what is read at the pauses of a coupon.
void put_pauses(FeatureValues& values, const measurement::PauseReadings& pauses);

/// Whether a tensile curve goes back on its way.
bool is_unloaded(const tester::Curve& curve, const CurveReading& reading);

/// The strain up to which a tensile curve is read: where it carries four fifths of its largest stress, so that a
/// material that flows is read while it flows, and none while it parts; empty when it was unloaded on the way (then all
/// of the curve is read).
std::optional<double> carried_strain(const tester::Curve& curve, const CurveReading& reading);

}  // namespace nacre::diagnosis
