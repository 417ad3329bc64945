#pragma once
// The elastic response of a pattern alone: a unit of an endless specimen, pulled. A tenth of the cost of a modulus
// test and a two thousandth of that of a fracture test at `preview`, so that a search can use it for every pattern that
// it visits.

#include <array>

#include "base/result.hpp"
#include "material/parameters.hpp"
#include "pattern/layout.hpp"
#include "tester/assembly.hpp"

namespace nacre::tester {

/// Blocks along one side of the quarter of a unit.
inline constexpr int kCellBlocks = 4;

struct UnitCell {
  double modulus_pa = 0.0;
  /// Strain energy density over the threshold, at a strain of 1 of the linear solution, mean over each block of the
  /// quarter: how near to failing a block is when others fail. Row by row along the pull, from the edge of the unit to
  /// its middle.
  std::array<double, kCellBlocks * kCellBlocks> load{};
};

/// The quarter between mirror lines of the grid of assemble() at usual conditions, with the constants of `target`,
/// sides free to contract. The parameters must be usable. Error: a part without stiffness.
Result<UnitCell> pull_unit_cell(const pattern::Pattern& pattern, const material::ParameterSet& parameters,
                                AssemblyTarget target);

}  // namespace nacre::tester
