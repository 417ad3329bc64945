#pragma once
// Test results that nothing was simulated for: a soak that wants many rounds plays with these.

#include <string>

#include "base/random.hpp"
#include "tester/curve.hpp"

namespace nacre::soak {

struct MadeUp {
  double modulus_pa = 0.0;
  tester::Curve curve;  ///< strain, stress in Pa; rises to its peak and falls to nothing
};

/// The same for the same text; E from 0.5 to 2.5 GPa, T from 50 to 550 kPa.
inline MadeUp made_up(const std::string& what) {
  constexpr int kPoints = 100;
  RandomStream random(1, "made up " + what);
  MadeUp result{.modulus_pa = 5e8 + 2e9 * random.uniform(), .curve = {}};
  const double failure_strain = 0.05 + 0.05 * random.uniform(), peak_pa = 2e6 + 9e6 * random.uniform();
  for (int i = 0; i <= kPoints; ++i) {
    const double share = static_cast<double>(i) / kPoints;
    result.curve.strain.push_back(failure_strain * share);
    result.curve.stress_pa.push_back(peak_pa * (share < 0.8 ? share / 0.8 : 5.0 * (1.0 - share)));
  }
  return result;
}

}  // namespace nacre::soak
