#pragma once
// The normalised performance space and its radial bins (thesis 2.3.4, Figure 2-11).

#include <span>
#include <vector>

#include "explore/search.hpp"

namespace nacre::select {

/// Elevation angle in [0, pi] of every candidate in the normalised space [-1, 1] x [0, 1]: toughness runs linearly from
/// 0 to 1 over the candidates, modulus linearly with the stiffest at 1 and 0 at the modulus of the toughest, or at the
/// middle of the range where that is smaller. Candidates that are all equally tough lie at height 1, a candidate in the
/// origin at pi/2.
std::vector<double> elevation_angles(std::span<const explore::Evaluated> candidates);

/// L of Eq. 2.13 (pi in place of phi): how many of `count` bins lie in the second quadrant. At most count - 1.
int second_quadrant_bins(double largest_angle, int count);

/// Bin 0..count-1 of an angle: bins 0..L-1 share (pi/2, largest_angle] equally, the others [0, pi/2], from large angles
/// to small. With L = 0, angles beyond pi/2 fall into bin 0.
int radial_bin(double angle, double largest_angle, int count);

/// The bin of every candidate.
std::vector<int> radial_bins(std::span<const explore::Evaluated> candidates, int count);

}  // namespace nacre::select
