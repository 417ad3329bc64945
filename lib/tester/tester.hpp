#pragma once
// The two virtual testers (thesis 2.3.1): a design, parameters and test conditions in; modulus, or toughness with its
// curve, out. Pure functions: same input, same bits, on any number of threads.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "material/parameters.hpp"
#include "pattern/design.hpp"
#include "tester/curve.hpp"

namespace nacre::tester {

/// Raised when a golden result changes, so that caches never mix results of different kernels.
inline constexpr int kKernelVersion = 8;

/// Named sizes of the virtual specimens. Values of different fidelity are never compared with each other.
enum class Fidelity {
  tiny,     ///< one unit; for process and fault tests; reports say so
  preview,  ///< thesis geometry pulled twice as fast; for searches, demonstrations and early rounds
  full,     ///< thesis geometry: toughness 5 x 4 units (200 x 160 elements), modulus 2 x 1 units (80 x 40)
};
std::string_view to_string(Fidelity fidelity);
Result<Fidelity> fidelity_from_string(std::string_view name);

enum class TestKind { modulus, toughness, tensile };
std::string_view to_string(TestKind kind);
Result<TestKind> test_kind_from_string(std::string_view name);

/// How a specimen is tested. Orientation 90 means printed turned by 90 degrees: the printer's axes, and with them every
/// directional effect, are exchanged with respect to the pulling direction.
struct TestConditions {
  double orientation_deg = 0.0;
  double strain_rate_per_s = 6.17e-4;
  double thickness_mm = 3.2;
  bool operator==(const TestConditions&) const = default;
};

/// What one simulation is asked.
struct Simulation {
  pattern::Design design;
  material::ParameterSet parameters;
  TestConditions conditions;
  Fidelity fidelity = Fidelity::full;
};

/// Numerical knobs, for verification and for the sanity step of a diagnosis. The defaults are the testers.
struct Discretisation {
  int refinement = 1;             ///< element size h / refinement, thresholds scaled by refinement
  double time_step_scale = 1.0;   ///< factor on the time step
  double rate_scale = 1.0;        ///< factor on the simulated strain rate (20 /s)
  int recording_scale = 1;        ///< factor on the number of recorded samples
  bool explicit_modulus = false;  ///< modulus by explicit integration with gamma instead of the static solver
  int specimen = 0;               ///< which of the specimens whose voxels' strength scatters (strength_scatter)
  int frame_count = 0;            ///< fracture frames to keep, placed by film_strains() (film_strains.hpp); 0 none
};

struct ModulusResult {
  double modulus_pa = 0.0;
};

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

/// Why a fracture test ended.
enum class EndReason { stress_drop, strain_limit, no_failure, step_limit };
std::string_view to_string(EndReason reason);

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

/// Young's modulus (2.3.1, Figure 2-5B). Layouts: static solve at strain 1e-4, double precision. Homogeneous designs:
/// material point. Error: what made the solution impossible.
Result<ModulusResult> test_modulus(const Simulation& simulation, const Discretisation& discretisation = {});

/// Toughness (2.3.1, Figure 2-5A): the notched specimen pulled at 20 /s until separation; layouts and homogeneous
/// designs alike run on the grid. Error: blow-up (J <= 0 or not finite) with step and element, never a number.
Result<ToughnessResult> test_toughness(const Simulation& simulation, const Discretisation& discretisation = {});

/// The unnotched homogeneous coupon: stress at each of the given nominal strains, by a material-point integrator at
/// real time.
Result<Curve> test_tensile(const Simulation& simulation, const std::vector<double>& strain_history);

/// Content hash of the question, kernel version included: the key of the farm's cache.
std::string simulation_key(const Simulation& simulation, TestKind kind);

}  // namespace nacre::tester
