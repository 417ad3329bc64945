#pragma once
// The fidelities, the kinds of test and the reasons why a test ends, with their names in files and messages.

#include <string_view>

#include "base/result.hpp"

namespace nacre::tester {

/// Presets of size and loading rate of the virtual specimens. Values of different fidelities are never compared.
enum class Fidelity {
  tiny,     ///< one unit; for tests of processes and faults; marked in reports
  preview,  ///< thesis geometry pulled twice as fast; for searches, demonstrations and early rounds
  full,     ///< thesis geometry: toughness 5 x 4 units (200 x 160 elements), modulus 2 x 1 units (80 x 40)
  fine,     ///< full on elements of half the size, quarter pixels: the reference that others are measured against
};
std::string_view to_string(Fidelity fidelity);
Result<Fidelity> fidelity_from_string(std::string_view name);

enum class TestKind { modulus, toughness, tensile };
std::string_view to_string(TestKind kind);
Result<TestKind> test_kind_from_string(std::string_view name);

/// Why a fracture test ended.
enum class EndReason { stress_drop, strain_limit, no_failure, step_limit };
std::string_view to_string(EndReason reason);

}  // namespace nacre::tester
