#pragma once

#include <span>

namespace nacre::sysid {

/// Spearman's rank correlation, ties sharing their mean rank; 0 below three pairs or when one side does not vary. Both
/// sides of the same length.
double rank_correlation(std::span<const double> a, std::span<const double> b);

}  // namespace nacre::sysid
