#pragma once
// Sample weights w1 w2 of system identification (thesis Eqs. 2.9-2.11, Figures 2-7 and 2-8): w1 falls with the distance
// from the front of the normalised (E, T) plane, w2 with the density of samples.

#include <vector>

#include "measurement/summary.hpp"

namespace nacre::sysid {

/// Weights of measured designs that have both E and T; designs with one of them get weight 1.
std::vector<double> sample_weights(const std::vector<measurement::Replicates>& measured);

}  // namespace nacre::sysid
