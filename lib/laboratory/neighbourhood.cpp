#include "laboratory/neighbourhood.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::laboratory {
namespace {

/// An element whose own energy is clearly below the mean stands: its neighbour is the one that fails.
constexpr double kLeastOwnShare = 0.99;

}  // namespace

Neighbourhood::Neighbourhood(const Raster& raster, std::size_t stride)
    : columns_(raster.columns),
      rows_(raster.rows),
      stride_(stride),
      energy_(stride * static_cast<std::size_t>(raster.rows), 0.0f),
      inverse_w_(energy_.size(), 0.0f),
      is_softening_(energy_.size(), 0) {
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const int e = row * columns_ + column;
      if (raster.mu_pa[e] > 0.0)
        inverse_w_[stride_ * static_cast<std::size_t>(row) + static_cast<std::size_t>(column)] =
            static_cast<float>(1.0 / raster.threshold_j_per_m3[e]);
    }
  const double radius = raster.neighbourhood_m / kElementM;
  double sum = 0.0;
  for (int away = 0; away < std::max(1.0, radius); ++away) {
    weights_.push_back(1.0 - away / radius);
    sum += weights_.back() * (away > 0 ? 2.0 : 1.0);
  }
  for (double& weight : weights_) weight /= sum;
}

double Neighbourhood::mean_ratio(int row, int column) const {
  const int reach = static_cast<int>(weights_.size()) - 1;
  double mean = 0.0;
  for (int r = std::max(0, row - reach); r <= std::min(rows_ - 1, row + reach); ++r)
    for (int c = std::max(0, column - reach); c <= std::min(columns_ - 1, column + reach); ++c) {
      const std::size_t at = stride_ * static_cast<std::size_t>(r) + static_cast<std::size_t>(c);
      mean += weights_[std::abs(r - row)] * weights_[std::abs(c - column)] * energy_[at] * inverse_w_[at];
    }
  return mean;
}

void Neighbourhood::settle(std::vector<float>& mu, std::vector<float>& lambda, HiddenSpecimen* hidden) {
  std::vector<std::size_t> failing;
  for (int row = 0; row < rows_; ++row) {
    const std::size_t first = stride_ * static_cast<std::size_t>(row);
    float largest = 0.0f;
    for (int c = 0; c < columns_; ++c) largest = std::max(largest, energy_[first + c] * inverse_w_[first + c]);
    if (largest < kLeastOwnShare) continue;
    for (int c = 0; c < columns_; ++c) {
      const std::size_t at = first + static_cast<std::size_t>(c);
      const double own = energy_[at] * inverse_w_[at];
      if (own < kLeastOwnShare || mu[at] == 0.0f || is_softening_[at] != 0) continue;
      const double mean = mean_ratio(row, c);
      if (mean >= 1.0 && own >= kLeastOwnShare * mean) failing.push_back(at);
    }
  }
  for (const std::size_t at : failing) {
    if (hidden != nullptr && hidden->softens()) {
      hidden->begin_to_soften(at, energy_[at]);
      is_softening_[at] = 1;
      continue;
    }
    mu[at] = lambda[at] = 0.0f;
    inverse_w_[at] = 0.0f;
  }
}

}  // namespace nacre::laboratory
