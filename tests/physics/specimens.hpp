#pragma once
// Specimens that the suites of this folder pull: small ones of patterns that are the same in every test.

#include <algorithm>
#include <vector>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/fracture_test.hpp"

namespace nacre::verification {

inline tester::Simulation specimen(const pattern::Design& design, tester::Fidelity fidelity = tester::Fidelity::tiny) {
  return {.design = design, .parameters = material::default_parameters(), .conditions = {}, .fidelity = fidelity};
}

/// published_a and random patterns of 50 to 85 % rigid pixels.
inline std::vector<pattern::Design> patterns(int count) {
  std::vector<pattern::Design> designs = {pattern::design_from_name("577fffe9fffdef").value()};
  RandomStream random(1, "fracture test");
  while (static_cast<int>(designs.size()) < count) designs.emplace_back(pattern::random_pattern(random));
  return designs;
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
