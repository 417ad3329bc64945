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

  bool softens() const { return step_.softening.linear > 0.0f || step_.softening.drawn_out > 0.0f; }
  /// The element at that place of padded rows softens from this energy density (J/m^3) on.
  void begin_to_soften(std::size_t at, float energy_j_per_m3);

 private:
  float* row_of(std::vector<float>& field, int row) { return &field[static_cast<std::size_t>(row) * stride_]; }

  std::size_t stride_;
  bool only_softens_;  ///< nothing else is hidden: the simpler kernel does
  HiddenParts parts_;
  float last_energy_ = 1.0f;  ///< energy density over that of the onset, at which an element is gone
  HiddenStep step_;
  std::vector<float> flow_limit_, inverse_limit_, eigenstrain_, overstress_, onset_, threshold_, integrity_;
  std::array<std::array<std::vector<float>, 2>, 4> plastic_;
  std::array<std::vector<float>, 4> work_;
  std::array<std::array<std::vector<float>, 3>, 4> viscous_;
};

}  // namespace nacre::laboratory
