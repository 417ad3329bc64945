#pragma once
// The history of a specimen whose material has hidden effects, for the fracture bench.

#include <array>
#include <vector>

#include "laboratory/hidden_kernel.hpp"
#include "laboratory/specimen_raster.hpp"

namespace nacre::laboratory {

/// By how much the hidden law of element `e` can be stiffer than its mu and lambda say, before it breaks; 1 without.
double hidden_stiffening(const Raster& raster, std::size_t e);

/// Mean of E between the bounds of Voigt and Reuss over what stands.
double mean_modulus(const Raster& raster);

class HiddenSpecimen {
 public:
  HiddenSpecimen(const Raster& raster, double time_step_s);

  /// One step of one row of elements; see advance_elements().
  int advance(int row, ElementRow elements, const ElementStep& step);
  /// Sets the eigenstrains to this share of their values.
  void shrink(double share) { step_.eigen_scale = static_cast<float>(share); }

 private:
  float* row_of(std::vector<float>& field, int row) { return &field[static_cast<std::size_t>(row) * stride_]; }

  std::size_t stride_;
  HiddenStep step_;
  std::vector<float> flow_limit_, inverse_limit_, eigenstrain_, overstress_, onset_, threshold_, integrity_;
  std::array<std::array<std::vector<float>, 2>, 4> plastic_;
  std::array<std::vector<float>, 4> work_;
  std::array<std::array<std::vector<float>, 3>, 4> viscous_;
};

}  // namespace nacre::laboratory
