#pragma once
// The toughness test in two parts: the notched specimen with its loading and discretisation, and the test itself.
// test_toughness() does both; verification changes the specimen in between.

#include "fem/explicit_solver.hpp"
#include "tester/fidelity.hpp"
#include "tester/toughness.hpp"

namespace nacre::tester {

struct FractureTest {
  fem::Grid grid;  ///< notched
  fem::ExplicitSettings settings;
  double strain_limit = 0.0;
  bool limit_is_no_failure = false;  ///< pure soft material: it is not expected to break
  int steps_per_sample = 1;
  int frame_count = 0;                ///< frames placed by film_strains(), for which the specimen is pulled twice
  std::vector<double> frame_strains;  ///< or a frame at the first step that reaches each of these; increasing
};

/// The specimen of a simulation, ready to be pulled. The simulation must be usable (simulation_fault empty).
FractureTest fracture_test(const Simulation& simulation, const Discretisation& discretisation = {});

/// A specimen in the grips, which carry no force, and the strain at which they do so.
template <class Real>
struct MountedSpecimen {
  fem::ExplicitSolver<Real> solver;
  double rest_strain = 0.0;
  /// Strain of the grips, from where they carry no force.
  double grip_strain(double strain) const { return (strain - rest_strain) / (1.0 + rest_strain); }
};

/// Mounts the specimen of a test; one whose material shrank has come to rest before. Error: what the solver refuses.
template <class Real>
Result<MountedSpecimen<Real>> mount(const FractureTest& test);
extern template Result<MountedSpecimen<float>> mount<float>(const FractureTest&);
extern template Result<MountedSpecimen<double>> mount<double>(const FractureTest&);

/// Pulls the specimen to separation. Real is float in the tester, double for comparison. Error: see test_toughness.
template <class Real>
Result<ToughnessResult> run_fracture_test(const FractureTest& test);
extern template Result<ToughnessResult> run_fracture_test<float>(const FractureTest&);
extern template Result<ToughnessResult> run_fracture_test<double>(const FractureTest&);

}  // namespace nacre::tester
