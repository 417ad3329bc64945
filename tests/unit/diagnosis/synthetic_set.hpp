#pragma once
// Measurement sets made by the modulus tester itself: same discretisation, known truth, declared noise.

#include <cmath>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "measurement/observe.hpp"
#include "measurement/specimen_record.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/modulus.hpp"
#include "tester/tensile.hpp"

namespace nacre::diagnosis {

struct SyntheticSet {
  int patterns = 12;
  int twins = 5;  ///< of the first patterns, printed turned
  int replicates = 3;
  double noise = 0.015;
  std::uint64_t seed = 1;
  int refinement = 1;  ///< elements of the specimens: 2 is a finer mesh than that of the diagnosis
};

/// Specimens whose moduli the tester predicts for `truth`, with lognormal replicate noise.
inline std::vector<measurement::SpecimenRecord> synthetic_specimens(const SyntheticSet& set,
                                                                    const material::ParameterSet& truth) {
  RandomStream noise(set.seed, "test/noise");
  std::vector<measurement::SpecimenRecord> specimens;
  RandomStream drawn(set.seed, "test/patterns");
  const std::vector<pattern::Pattern> patterns = pattern::stratified_patterns(set.patterns, drawn);
  const auto test = [&](const pattern::Design& design, double orientation_deg) {
    tester::Simulation simulation{design, truth, {}, tester::Fidelity::tiny};
    simulation.conditions.orientation_deg = orientation_deg;
    const double true_modulus = tester::test_modulus(simulation, {.refinement = set.refinement}).value().modulus_pa;
    for (int i = 0; i < set.replicates; ++i) {
      measurement::SpecimenRecord specimen;
      specimen.specimen =
          design.name() + "-" + std::to_string(static_cast<int>(orientation_deg)) + "-" + std::to_string(i);
      specimen.design = design;
      specimen.conditions = simulation.conditions;
      specimen.batch = "batch-" + std::to_string(i + 1);
      specimen.modulus_pa =
          measurement::observe_modulus(true_modulus, truth.extensions, {.batch_step = static_cast<double>(i)}) *
          std::exp(set.noise * noise.normal());
      specimens.push_back(specimen);
    }
  };
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    test(patterns[i], 0.0);
    if (static_cast<int>(i) < set.twins) test(patterns[i], 90.0);
  }
  return specimens;
}

/// Moduli of homogeneous soft, rigid and interface specimens of these materials, with lognormal replicate noise.
inline std::vector<measurement::SpecimenRecord> synthetic_base_materials(const material::ParameterSet& truth,
                                                                         int replicates = 3, double noise_sd = 0.015) {
  RandomStream noise(7, "test/base materials");
  std::vector<measurement::SpecimenRecord> specimens;
  for (const double fraction : {0.0, 0.5, 1.0}) {
    for (int r = 0; r < replicates; ++r) {
      measurement::SpecimenRecord specimen;
      specimen.design = pattern::Mixture{fraction};
      specimen.specimen = specimen.design.name() + "-" + std::to_string(r);
      specimen.modulus_pa =
          tester::test_modulus({specimen.design, truth, {}, tester::Fidelity::tiny}).value().modulus_pa *
          std::exp(noise_sd * noise.normal());
      specimens.push_back(specimen);
    }
  }
  return specimens;
}

inline std::vector<double> pulled_to_two_percent() {
  std::vector<double> strains;
  for (int i = 0; i <= 60; ++i) strains.push_back(0.02 * i / 60);
  return strains;
}

/// Homogeneous coupons pulled along `strains` of their own, one of each mixture and rate, as the material point
/// predicts them for `truth`, with lognormal scatter of stress.
inline std::vector<measurement::SpecimenRecord> synthetic_coupons(
    const material::ParameterSet& truth, const std::vector<double>& rates_per_s, int replicates, double noise_sd,
    std::uint64_t seed, const std::vector<double>& strains = pulled_to_two_percent()) {
  RandomStream noise(seed, "test/coupons");
  std::vector<measurement::SpecimenRecord> specimens;
  for (const double fraction : {0.0, 0.25, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
    for (const double rate : rates_per_s) {
      for (int r = 0; r < replicates; ++r) {
        measurement::SpecimenRecord specimen;
        specimen.design = pattern::Mixture{fraction};
        specimen.test = tester::TestKind::tensile;
        specimen.conditions.strain_rate_per_s = rate;
        specimen.specimen = specimen.design.name() + "-" + std::to_string(rate) + "-" + std::to_string(r);
        specimen.curve = measurement::observe_curve(
            tester::test_tensile({specimen.design, truth, specimen.conditions, tester::Fidelity::tiny}, strains)
                .value(),
            truth.extensions);
        const double factor = std::exp(noise_sd * noise.normal());
        for (double& stress : specimen.curve.stress_pa) stress *= factor;
        specimens.push_back(specimen);
      }
    }
  }
  return specimens;
}

/// A truth that the base fit has to find first: constants away from the defaults.
inline material::ParameterSet synthetic_truth() {
  material::ParameterSet truth = material::thesis_parameters();
  truth.modulus.e_vw_pa *= 0.93;
  truth.modulus.e_if_pa *= 1.08;
  truth.modulus.nu_vw = 0.33;
  return truth;
}

}  // namespace nacre::diagnosis
