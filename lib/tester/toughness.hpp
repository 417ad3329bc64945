#pragma once
// The toughness tester (thesis 2.3.1, Figure 2-5A): T is the area under the nominal stress-strain curve of a notched
// specimen that is pulled to separation (Eq. 2.6).

#include <cstdint>
#include <vector>

#include "tester/curve.hpp"
#include "tester/simulation.hpp"

namespace nacre::tester {

/// One moment of a fracture test, for films; row 0 at the bottom.
struct FractureFrame {
  double strain = 0.0;
  int columns = 0;
  int rows = 0;
  double element_size_m = 0.0;
  std::vector<std::uint8_t> material;  ///< per element: 0 soft, 1 rigid, 2 interface, 3 void or failed
  std::vector<float> energy_j_per_m3;  ///< per element: largest strain energy density at its quadrature points
  std::vector<float> displacement_m;   ///< per node, (x, y) in turn; node = row * (columns + 1) + column
};

/// An element that failed, and the grips' strain at the step in which it passed its threshold.
struct Break {
  int element = 0;  ///< row * columns + column, row 0 at the bottom
  double strain = 0.0;
  bool operator==(const Break&) const = default;
};

struct ToughnessResult {
  double toughness_pa = 0.0;    ///< area under the curve (Eq. 2.6)
  double peak_stress_pa = 0.0;  ///< of the smoothed curve
  double failure_strain = 0.0;  ///< strain at which the test ended
  Curve curve;
  EndReason end = EndReason::stress_drop;
  std::int64_t steps = 0;
  std::int64_t element_count = 0;
  std::vector<Break> breaks;  ///< in the order of failing; within one step by element
  std::vector<FractureFrame> frames;
};

/// The notched specimen pulled at 20 /s until separation; layouts and homogeneous designs alike run on the grid. Error:
/// blow-up (J <= 0 or not finite) with step and element, never a number.
Result<ToughnessResult> test_toughness(const Simulation& simulation, const Discretisation& discretisation = {});

}  // namespace nacre::tester
