#pragma once
// How fast a specimen was strained.

#include <optional>
#include <vector>

#include "tester/curve.hpp"

namespace nacre::measurement {

/// Strain rate of loading, 1/s: the slope of strain over time by least squares between 10 and 40 % of the peak stress.
/// Where fewer than five ticks of the clock lie there, or noise leaves a standard error above 1 %, between 5 and 60 %,
/// up to the peak, then over the record, as long as the residuals are the strain's own noise: another speed is not.
/// Of a test that was held there, the rate at which it moves. Nothing without time, or where time does not advance.
std::optional<double> strain_rate(const std::vector<double>& time_s, const tester::Curve& curve);

}  // namespace nacre::measurement
