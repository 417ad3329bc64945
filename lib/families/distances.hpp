#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "pattern/layout.hpp"

namespace nacre::families {

/// Symmetric matrix with zeros on its diagonal, single precision, half of it stored.
class DistanceMatrix {
 public:
  explicit DistanceMatrix(std::size_t count) : count_(count), values_(count * (count - (count > 0)) / 2) {}
  std::size_t count() const { return count_; }
  double operator()(std::size_t i, std::size_t j) const { return i == j ? 0.0 : values_[place(i, j)]; }
  void set(std::size_t i, std::size_t j, double value) { values_[place(i, j)] = static_cast<float>(value); }

 private:
  static std::size_t place(std::size_t i, std::size_t j) { return i > j ? i * (i - 1) / 2 + j : j * (j - 1) / 2 + i; }
  std::size_t count_;
  std::vector<float> values_;
};

/// Earth mover's distances between all pairs of patterns, on all allowed cores. `progress` gets the finished share,
/// 0..1, now and then, from any thread. 3000 patterns of one subfamily take about a minute of two cores.
DistanceMatrix earth_movers_distances(std::span<const pattern::Pattern> patterns,
                                      const std::function<void(double)>& progress = {});

/// 0 when there is none.
double largest_finite(const DistanceMatrix& distances);

}  // namespace nacre::families
