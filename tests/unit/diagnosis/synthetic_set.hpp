#pragma once
// Measurement sets made by the modulus tester itself: same numerics, known truth, declared noise.

#include <cmath>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "measurement/measurement.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/tester.hpp"

namespace nacre::diagnosis {

struct SyntheticSet {
  int patterns = 12;
  int twins = 5;  ///< of the first patterns, printed turned
  int replicates = 3;
  double noise = 0.015;
  std::uint64_t seed = 1;
  int refinement = 1;  ///< elements of the specimens: 2 is another numerics than the diagnosis has
};

/// Specimens whose moduli the tester predicts for `truth`, with lognormal replicate noise.
inline std::vector<measurement::SpecimenRecord> synthetic_specimens(const SyntheticSet& set, const material::ParameterSet& truth) {
  RandomStream noise(set.seed, "test/noise");
  std::vector<measurement::SpecimenRecord> specimens;
  RandomStream drawn(set.seed, "test/patterns");
  const std::vector<pattern::Pattern> patterns = pattern::stratified_patterns(set.patterns, drawn);
  const auto test = [&](const pattern::Design& design, double orientation_deg) {
    tester::Simulation simulation{design, truth, {}, tester::Fidelity::tiny};
    simulation.conditions.orientation_deg = orientation_deg;
    const double modulus = measurement::observe_modulus(tester::test_modulus(simulation, {.refinement = set.refinement}).value().modulus_pa, truth.extensions);
    for (int i = 0; i < set.replicates; ++i) {
      measurement::SpecimenRecord specimen;
      specimen.specimen = design.name() + "-" + std::to_string(static_cast<int>(orientation_deg)) + "-" + std::to_string(i);
      specimen.design = design;
      specimen.conditions = simulation.conditions;
      specimen.modulus_pa = modulus * std::exp(set.noise * noise.normal());
      specimens.push_back(specimen);
    }
  };
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    test(patterns[i], 0.0);
    if (static_cast<int>(i) < set.twins) test(patterns[i], 90.0);
  }
  return specimens;
}

/// A truth that the base fit has to find first: constants away from the defaults.
inline material::ParameterSet synthetic_truth() {
  material::ParameterSet truth = material::default_parameters();
  truth.modulus.e_vw_pa *= 0.93;
  truth.modulus.e_if_pa *= 1.08;
  truth.modulus.nu_vw = 0.33;
  return truth;
}

}  // namespace nacre::diagnosis
