#include "families/distances.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/parallel.hpp"
#include "families/earth_movers.hpp"

namespace nacre::families {

DistanceMatrix earth_movers_distances(std::span<const pattern::Pattern> patterns,
                                      const std::function<void(double)>& progress) {
  DistanceMatrix matrix(patterns.size());
  std::atomic<std::size_t> done = 0;
  const double all = static_cast<double>(patterns.size()) * (static_cast<double>(patterns.size()) - 1.0) / 2.0;
  // Rows from the longest to the shortest, so that no thread is left with a long one at the end.
  parallel_for(patterns.size(), [&](int k) {
    const std::size_t i = patterns.size() - 1 - static_cast<std::size_t>(k);
    for (std::size_t j = 0; j < i; ++j) matrix.set(i, j, earth_movers_distance(patterns[i], patterns[j]));
    const std::size_t pairs = done += i;
    if (progress && all > 0.0) progress(static_cast<double>(pairs) / all);
  });
  return matrix;
}

double largest_finite(const DistanceMatrix& distances) {
  double largest = 0.0;
  for (std::size_t i = 0; i < distances.count(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::isfinite(distances(i, j))) largest = std::max(largest, distances(i, j));
  return largest;
}

}  // namespace nacre::families
