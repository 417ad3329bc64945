#pragma once
// The crack of one specimen, from the order in which its elements failed. Elements touch across sides and corners; the
// lengths are between centres, at most 8 % above those of the smooth line (steps of 0, 45 and 90 degrees).

#include <array>
#include <optional>
#include <vector>

#include "fem/grid.hpp"
#include "tester/toughness.hpp"

namespace nacre::crack {

/// Failed elements off the path count as a branch from a length of 6 elements (3 pixels, 1.56 mm) on.
inline constexpr double kShortestBranchElements = 6.0;
/// Number of failed elements, touching no other crack, from which on they count as a separate crack.
inline constexpr int kSmallestCrackElements = 4;
/// Cost of an intact element relative to a failed one: the path leaves the cracks only where they end.
inline constexpr double kIntactCost = 4.0;

/// The shortest path from the notch to the failed element farthest from it, through failed elements where there are
/// any.
struct CrackPath {
  std::vector<int> elements;         ///< from the notch on, each touching the next
  double length_m = 0.0;             ///< between the centres, plus half an element at either end
  double straight_length_m = 0.0;    ///< of the straight crack across the same columns, perpendicular to the pull
  double bridged_share = 0.0;        ///< of the length, through intact elements: 0..1
  std::array<double, 3> material{};  ///< shares of the failed length in soft, rigid, interface (fem::Phase); sum 1
  bool crosses = false;              ///< it reaches the edge opposite to the notch

  /// Path length over straight length, >= 1.
  double ratio() const { return length_m / straight_length_m; }
  bool operator==(const CrackPath&) const = default;
};

/// The crack of one specimen.
struct CrackRecord {
  int columns = 0, rows = 0;         ///< of the specimen; element = row * columns + column, row 0 at the bottom
  std::vector<tester::Break> order;  ///< failed elements in the order of failing
  std::optional<CrackPath> path;     ///< nothing when no element failed
  int branches = 0;                  ///< branches off the path, of kShortestBranchElements or more
  int separate_cracks = 0;           ///< groups of kSmallestCrackElements or more that do not touch the path's crack
  bool operator==(const CrackRecord&) const = default;
};

/// The record of a crack in the notched specimen as it was before the test; of the grid only shape, size of the
/// elements and phases are used. The elements of `order` are not empty in the grid, each occurs once. Mirroring
/// grid and order mirrors the record, except where paths are equally long and failed in the same steps. Cost: some
/// milliseconds at full fidelity.
CrackRecord crack_record(const fem::Grid& notched, std::vector<tester::Break> order);

/// The same for the toughness test of a simulation (unrefined). `order` comes from its ToughnessResult.
CrackRecord record_of(const tester::Simulation& simulation, std::vector<tester::Break> order);

}  // namespace nacre::crack
