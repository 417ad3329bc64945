#pragma once
// The input of the two virtual testers (thesis 2.3.1): design, parameters and test conditions, and how they are
// discretised. The testers (modulus.hpp, toughness.hpp, tensile.hpp) are pure functions of it: same input, same bits,
// on any number of threads.

#include "material/parameters.hpp"
#include "pattern/design.hpp"
#include "tester/names.hpp"

namespace nacre::tester {

/// How a specimen is tested. Orientation 90 means printed turned by 90 degrees: the printer's axes, and with them every
/// directional effect, are exchanged with respect to the pulling direction.
struct TestConditions {
  double orientation_deg = 0.0;
  double strain_rate_per_s = 6.17e-4;
  double thickness_mm = 3.2;
  bool operator==(const TestConditions&) const = default;
};

/// What one simulation computes.
struct Simulation {
  pattern::Design design;
  material::ParameterSet parameters;
  TestConditions conditions;
  Fidelity fidelity = Fidelity::full;
  /// Which of the specimens of its design, whose strength varies (strength_cv, strength_scatter). Of the fracture test.
  int specimen = 0;
};

/// Numerical settings, for verification and for the sanity checks of a diagnosis. The defaults are the testers.
struct Discretisation {
  int refinement = 1;             ///< element size h / refinement
  double time_step_scale = 1.0;   ///< factor on the time step
  double rate_scale = 1.0;        ///< factor on the simulated strain rate (20 /s)
  int recording_scale = 1;        ///< factor on the number of recorded samples
  bool explicit_modulus = false;  ///< modulus by explicit integration with gamma instead of the static solver
  int frame_count = 0;            ///< fracture frames to keep, placed by film_strains() (film_strains.hpp); 0 none
};

}  // namespace nacre::tester
