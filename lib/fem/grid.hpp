#pragma once
// The finite-element grid shared by all solvers: columns x rows square four-node elements, row 0 at the bottom (the
// fixed grip), column 0 at the left (the notch). Element e = row * columns + column; node n = row * (columns + 1) +
// column.

#include <cstdint>
#include <vector>

namespace nacre::fem {

/// Phase of an element; `empty` elements carry nothing (notch, cut, failed).
enum class Phase : std::uint8_t { soft = 0, rigid = 1, interface = 2, empty = 3 };

/// Extensions of the elements' law (material/extended_law.hpp); empty vectors and zeros are the base law.
struct GridLaws {
  std::vector<double> eigenstrain;    ///< columns * rows, strain
  std::vector<double> inverse_limit;  ///< columns * rows, 1 / J_m
  std::vector<double> yield_pa;       ///< columns * rows, infinity where nothing flows
  double overstress = 0.0;
  double relaxation_time_s = 0.0;  ///< in the time of the integrator
  double softening = 0.0;
  double tension_only = 0.0;
  /// The softening is a crack band's: without another law it goes through a faster kernel, whose rounding differs.
  bool is_crack_band = false;
  bool any() const { return softening != 0.0 || any_beside_softening(); }
  bool any_beside_softening() const {
    return !eigenstrain.empty() || !inverse_limit.empty() || !yield_pa.empty() || overstress != 0.0 ||
           tension_only != 0.0;
  }
};

/// Elements with their own elastic constants and failure threshold, so that mixtures and extensions cost the kernels
/// nothing.
struct Grid {
  int columns = 0;
  int rows = 0;
  double element_size_m = 0.0;
  std::vector<Phase> phase;                ///< columns * rows
  std::vector<double> young_pa;            ///< E of Eq. 2.3; ignored where empty
  std::vector<double> poisson;             ///< nu of Eq. 2.3
  std::vector<double> threshold_j_per_m3;  ///< W at which an element fails; infinity in the modulus tester
  GridLaws laws = {};
  double neighbourhood_m = 0.0;  ///< R of the neighbourhood criterion (neighbourhood.hpp); 0: each element by itself
  int index(int row, int column) const { return row * columns + column; }
  int element_count() const { return columns * rows; }
};

}  // namespace nacre::fem
