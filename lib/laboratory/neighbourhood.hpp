#pragma once
// Failure by the mean over a neighbourhood, for the fracture bench: the laboratory's own sums of what the testers'
// criterion means (fem/neighbourhood.hpp).

#include <cstddef>
#include <vector>

#include "laboratory/hidden_specimen.hpp"
#include "laboratory/specimen_raster.hpp"

namespace nacre::laboratory {

class Neighbourhood {
 public:
  /// Of a raster with a radius. Rows of elements are padded to `stride`.
  Neighbourhood(const Raster& raster, std::size_t stride);

  /// Where the kernel leaves the mean energy density of a row of elements, J/m^3.
  float* energy_row(int row) { return &energy_[static_cast<std::size_t>(row) * stride_]; }

  /// Takes away what fails, or lets it begin to soften where `hidden` (nullptr: none) softens. `mu` and `lambda` have
  /// padded rows.
  void settle(std::vector<float>& mu, std::vector<float>& lambda, HiddenSpecimen* hidden);

 private:
  double mean_ratio(int row, int column) const;

  int columns_, rows_;
  std::size_t stride_;
  std::vector<double> weights_;     ///< of elements 0, 1, ... away along one axis, both sides with sum 1
  std::vector<float> energy_;       ///< J/m^3
  std::vector<float> inverse_w_;    ///< 1 / W, 0 where nothing stands
  std::vector<char> is_softening_;  ///< it has failed, and goes on along its tail
};

}  // namespace nacre::laboratory
