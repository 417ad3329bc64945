#pragma once

#include <vector>

namespace nacre::tester {

/// A nominal stress-strain curve. Both vectors have the same length; strain may decrease where a specimen was unloaded.
struct Curve {
  std::vector<double> strain;
  std::vector<double> stress_pa;
  bool empty() const { return strain.empty(); }
  std::size_t size() const { return strain.size(); }
  bool operator==(const Curve&) const = default;
};

/// Area under the curve by the trapezoidal rule (thesis Eq. 2.6), J/m^3 = Pa.
double area_under(const Curve& curve);

/// I[|a - b|] of Eq. 2.8: the area between two curves; a curve is zero beyond its end. Both with non-decreasing strain.
double area_between(const Curve& a, const Curve& b);

/// Largest difference in stress up to `until_strain` between two curves with the same strains, relative to the largest
/// stress of `a` up to there; 1 where that is zero.
double largest_difference(const Curve& a, const Curve& b, double until_strain);

/// Stress at `strain` by linear interpolation on a curve with non-decreasing strain; 0 outside it.
double stress_at(const Curve& curve, double strain);

/// The curve as far as `strain`, its last point interpolated.
Curve cut_at(const Curve& curve, double strain);

/// The curve at `points` >= 2 strains equally spaced from its first to its last strain, such that area_under is kept
/// (the stress samples are rescaled by the ratio of the areas).
Curve resampled(const Curve& curve, int points);

}  // namespace nacre::tester
