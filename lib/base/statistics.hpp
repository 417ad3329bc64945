#pragma once
// Statistics of lists of numbers.

#include <span>
#include <vector>

namespace nacre {

/// Of at least one value.
double mean(std::span<const double> values);

/// sqrt(sum of squares / (n - lost)), about zero; `lost` degrees of freedom were spent on a fit, n > lost.
double root_mean_square(std::span<const double> values, int lost = 0);

/// About the mean, over n - 1; 0 below two values.
double standard_deviation(std::span<const double> values);

/// Largest less smallest value; 0 of none.
double range_of(std::span<const double> values);

/// The value below which a share in [0, 1] of the values lies, interpolated between neighbours. At least one value.
double quantile(std::vector<double> values, double share);

/// Ranks from 1; equal values share the mean of the ranks they span.
std::vector<double> ranks_of(std::span<const double> values);

/// Spearman's rank correlation, ties sharing their mean rank; 0 below three pairs or when one side does not vary. Both
/// sides of the same length.
double rank_correlation(std::span<const double> a, std::span<const double> b);

/// Share of a standard normal distribution below x.
double normal_cdf(double x);

/// Chance that Student's t of so many degrees of freedom (at least 1) lies beyond t on either side (Abramowitz and
/// Stegun 26.7.3 and 26.7.4: exact).
double student_beyond(double t, int degrees);

/// Student's t that is exceeded on either side with this chance, by bisection.
double student_quantile(double chance, int degrees);

}  // namespace nacre
