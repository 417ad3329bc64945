#pragma once

#include <vector>

namespace nacre::numerics_floor {

double mean(const std::vector<double>& values);
/// sqrt(sum of squares / (n - lost)), about zero; `lost` degrees of freedom were spent on a fit.
double root_mean_square(const std::vector<double>& values, int lost = 0);
/// Standard deviation about the mean.
double standard_deviation(const std::vector<double>& values);
/// Rank correlation; ties get their mean rank.
double spearman(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace nacre::numerics_floor
