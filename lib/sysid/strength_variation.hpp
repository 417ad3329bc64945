#pragma once
// How strength varies between regions of a specimen, from the scatter of replicates. The variance of log T between
// specimens of design d is m^2 + (cv / c)^(2 p) f_d^2: m of measuring, the same in all designs; the other part as the
// tester says, from specimens of every design at a small and at a large variation (c is their geometric mean). p is
// below 1, since a crack takes another way at the least difference. Sample variances are those times chi squared over
// its degrees of freedom; both unknowns have log-normal priors, and the posterior is summed over a grid.

#include <span>
#include <vector>

#include "measurement/summary.hpp"
#include "sysid/prediction.hpp"

namespace nacre::sysid {

/// Variations of strength at which specimens are simulated: the 90 % interval of the prior of strength_cv.
inline constexpr double kSmallVariation = 0.05, kLargeVariation = 0.2;

/// Sample variances of log T between specimens of one design. Freedom: specimens - 1, at least 1.
struct DesignScatter {
  double measured_variance = 0.0;
  int measured_freedom = 1;
  double small_variance = 0.0, large_variance = 0.0;  ///< simulated at kSmallVariation, kLargeVariation
  int small_freedom = 1, large_freedom = 1;
};

struct StrengthVariation {
  double strength_cv = 0.0;          ///< median
  double low90 = 0.0, high90 = 0.0;  ///< 90 % interval of strength_cv
  double measuring_sd = 0.0;         ///< m, of log T: median
  double correlation = 0.0;          ///< of the logarithms of strength_cv and m in the posterior
  double measured_sd = 0.0;          ///< of log T, pooled over the designs
  double predicted_sd = 0.0;         ///< the same by the fitted model
  int freedom = 0;                   ///< of measured_sd
  /// The 90 % interval of strength_cv is less than half of the one that its prior alone gives.
  bool determined() const;
};

/// Scatter of the designs that have at least two measured and two simulated specimens at both variations.
std::vector<DesignScatter> design_scatter(const std::vector<measurement::Replicates>& measured,
                                          const std::vector<Prediction>& small, const std::vector<Prediction>& large);

/// What measuring T alone is expected to scatter by: force and strain scatter as those of the moduli do; 0.03 where no
/// modulus was measured twice.
double expected_measuring_sd(const std::vector<measurement::Replicates>& measured);

/// How simulated scatter grows with the variation of strength, from at least one design.
struct ScatterGrowth {
  double exponent = 0.0;          ///< p, 0 to 1, of all designs together
  std::vector<double> variances;  ///< f_d^2: shrunk to their mean by what chance adds to them
  /// Variance of design d by the field alone.
  double variance(std::size_t d, double strength_cv) const;
};
ScatterGrowth scatter_growth(std::span<const DesignScatter> designs);

/// Of at least one design. measuring_sd > 0: median of the prior of m (factor 2). The prior of strength_cv has median
/// 0.10 and factor 1.5 (material/failure_criterion.hpp).
StrengthVariation fit_strength_variation(std::span<const DesignScatter> designs, double measuring_sd);

}  // namespace nacre::sysid
