#pragma once

#include <cmath>

namespace nacre {

/// Matern's correlation of smoothness 5/2, (1 + a + a^2 / 3) exp(-a), at the scaled distance a = sqrt(5) r, where r is
/// the distance over the correlation length.
inline double matern52(double a) { return (1.0 + a + a * a / 3.0) * std::exp(-a); }

}  // namespace nacre
