#pragma once
// The fidelities, the kinds of test and of failure criterion and the reasons why a test ends, with their names in files
// and messages.

#include <string_view>

#include "base/result.hpp"

namespace nacre::tester {

/// Presets of size and loading rate of the virtual specimens. Values of different fidelities are never compared.
enum class Fidelity {
  tiny,     ///< one unit; for tests of processes and faults; marked in reports
  preview,  ///< thesis geometry pulled twice as fast; for searches, demonstrations and early rounds
  full,     ///< thesis geometry: toughness 5 x 4 units (200 x 160 elements), modulus 2 x 1 units (80 x 40)
};
std::string_view to_string(Fidelity fidelity);
Result<Fidelity> fidelity_from_string(std::string_view name);

enum class TestKind { modulus, toughness, tensile };
std::string_view to_string(TestKind kind);
Result<TestKind> test_kind_from_string(std::string_view name);

/// The energy density at which an element of the fracture tester fails is
enum class CriterionKind {
  element,        ///< its own, the threshold growing as 1/h so that the fracture energy stays (thesis 2.3.1)
  neighbourhood,  ///< the mean over a neighbourhood of a pixel or so (fem/neighbourhood.hpp), W at every h
  crack_band,     ///< its own, W at every h, beyond which a linear tail softens it, the longer the smaller h
};
std::string_view to_string(CriterionKind kind);
Result<CriterionKind> criterion_from_string(std::string_view name);

/// Why a fracture test ended.
enum class EndReason { stress_drop, strain_limit, no_failure, step_limit };
std::string_view to_string(EndReason reason);

}  // namespace nacre::tester
