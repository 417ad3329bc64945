#pragma once
// Toughening mechanisms (thesis 2.4.1, 3.3), each a number from the record of a crack.

#include <array>
#include <string_view>

#include "crack/crack_record.hpp"

namespace nacre::crack {

/// Each is 0 when the mechanism did not act.
struct Mechanisms {
  /// Deflection: length of the crack's path over that of the straight crack, minus one.
  double deflection = 0.0;
  /// Branching: number of branches off the path and of separate cracks.
  double branching = 0.0;
  /// Bridging: share of the path that is intact when the test ends; ligaments hold the faces together behind the tip.
  double bridging = 0.0;
  /// Soft-phase arrest: share of the strain between the path's first and last failure that passes while the tip waits
  /// in front of a soft element.
  double soft_arrest = 0.0;
  /// Defect guidance: share of the path's failed length in soft and interface elements less their share of the
  /// specimen. Below 0: the crack avoids them.
  double guidance = 0.0;
};

/// Names and explanations in the order of values_of().
struct Mechanism {
  std::string_view name;
  std::string_view meaning;
};
std::array<Mechanism, 5> mechanism_names();
std::array<double, 5> values_of(const Mechanisms& mechanisms);

/// From the record of a crack and the specimen's phases as they were before the test (notch empty). All zero without a
/// path.
Mechanisms mechanisms_of(const fem::Grid& notched, const CrackRecord& record);

/// The same for the toughness test of a simulation (unrefined).
Mechanisms mechanisms_of(const tester::Simulation& simulation, const CrackRecord& record);

}  // namespace nacre::crack
