#pragma once
// Isomap (Tenenbaum, de Silva, Langford 2000): a map in which distances are those along the data.

#include <Eigen/Core>

#include "families/distances.hpp"

namespace nacre::families {

struct Embedding {
  Eigen::MatrixX2d points;         ///< one row per pattern; centred, the first axis the longer one
  int bridges = 0;                 ///< edges that had to be added because the neighbour graph was not connected
  double residual_variance = 0.0;  ///< 1 - r^2 between geodesic and embedded distances: 0 is a perfect map
};

/// Embeds in two dimensions. Every pattern is joined to its `neighbours` nearest ones; unconnected parts are joined at
/// their nearest pair, shortest bridge first. Infinite distances count as ten times the largest finite
/// one. Throws InputError below four patterns or when neighbours < 1.
Embedding isomap(const DistanceMatrix& distances, int neighbours = 10);

}  // namespace nacre::families
