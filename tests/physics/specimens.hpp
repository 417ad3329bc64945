#pragma once
// Specimens that the suites of this folder pull: small ones of patterns that are the same in every test.

#include <algorithm>
#include <limits>
#include <vector>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "fem/explicit_solver.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/fracture_test.hpp"

namespace nacre::verification {

inline tester::Simulation specimen(const pattern::Design& design, tester::Fidelity fidelity = tester::Fidelity::tiny) {
  return {.design = design, .parameters = material::thesis_parameters(), .conditions = {}, .fidelity = fidelity};
}

/// published_a and random patterns of 50 to 85 % rigid pixels.
inline std::vector<pattern::Design> patterns(int count) {
  std::vector<pattern::Design> designs = {pattern::design_from_name("577fffe9fffdef").value()};
  RandomStream random(1, "fracture test");
  while (static_cast<int>(designs.size()) < count) designs.emplace_back(pattern::random_pattern(random));
  return designs;
}

/// A test with one instruction set: the stress at both grips step by step, and how many elements failed meanwhile.
struct Pulled {
  fem::SimdLevel level = fem::SimdLevel::baseline;
  std::vector<double> stresses_pa = {};
  int failed = 0;
};

/// With every instruction set that this machine has: so many steps, or fewer once `enough` elements have failed.
inline std::vector<Pulled> pulled_by_every_simd_level(tester::FractureTest test, int most_steps,
                                                      int enough = std::numeric_limits<int>::max()) {
  std::vector<Pulled> results;
  for (const fem::SimdLevel level : {fem::SimdLevel::baseline, fem::SimdLevel::avx2, fem::SimdLevel::avx512}) {
    if (!fem::has_simd_level(level)) continue;
    test.settings.simd = level;
    auto solver = fem::ExplicitSolver<float>::create(test.grid, test.settings).value();
    Pulled& pulled = results.emplace_back(Pulled{.level = level});
    for (int step = 0; step < most_steps && pulled.failed < enough; ++step) {
      const fem::StepReport report = solver.step().value();
      pulled.stresses_pa.push_back(report.top_stress_pa);
      pulled.stresses_pa.push_back(report.bottom_stress_pa);
      pulled.failed += report.failed;
    }
  }
  return results;
}

inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Relative differences of T between two ways of running the same specimens.
template <class A, class B>
std::vector<double> toughness_differences(const std::vector<pattern::Design>& designs, const A& a, const B& b) {
  std::vector<double> differences(designs.size());
  parallel_for(static_cast<int>(designs.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    const double first = a(specimen(designs[at])).value().toughness_pa,
                 second = b(specimen(designs[at])).value().toughness_pa;
    differences[at] = std::abs(first / second - 1.0);
  });
  return differences;
}

}  // namespace nacre::verification
