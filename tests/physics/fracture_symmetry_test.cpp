// A specimen seen from another side is the same specimen.

#include <gtest/gtest.h>

#include "specimens.hpp"
#include "tester/assembly.hpp"
#include "tester/modulus.hpp"

namespace nacre {
namespace {

using verification::patterns;
using verification::specimen;

/// The grid with its columns (or rows) in reverse order.
fem::Grid mirrored(const fem::Grid& grid, bool columns) {
  fem::Grid result = grid;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const int from = columns ? grid.index(row, grid.columns - 1 - column) : grid.index(grid.rows - 1 - row, column);
      const int to = grid.index(row, column);
      result.phase[to] = grid.phase[from];
      result.young_pa[to] = grid.young_pa[from];
      result.poisson[to] = grid.poisson[from];
      result.threshold_j_per_m3[to] = grid.threshold_j_per_m3[from];
    }
  return result;
}

// The kernel forms its sums so that mirrored specimens have mirrored bits; the reactions are summed in another order,
// in double: T within 1e-10, the same number of steps.
TEST(FractureSymmetry, MirroringTheModelMirrorsTheResult) {
  const tester::FractureTest test = tester::fracture_test(specimen(patterns(2)[1]));
  const tester::ToughnessResult plain = tester::run_fracture_test<float>(test).value();
  for (const bool columns : {true, false}) {
    tester::FractureTest turned = test;
    turned.grid = mirrored(test.grid, columns);
    const tester::ToughnessResult mirror = tester::run_fracture_test<float>(turned).value();
    EXPECT_EQ(mirror.steps, plain.steps);
    EXPECT_NEAR(mirror.toughness_pa / plain.toughness_pa, 1.0, 1e-10);
  }
}

/// A layout without any symmetry: left and lower part of one random pattern, the rest of another.
pattern::Layout lopsided_layout() {
  const pattern::Layout one = *patterns(2)[1].layout(), other = *patterns(3)[2].layout();
  pattern::Layout layout = one;
  for (int row = 0; row < pattern::kSide; ++row)
    for (int column = 0; column < pattern::kSide; ++column)
      if (row + 2 * column > 25) layout.set(row, column, other.rigid(row, column));
  return layout;
}

tester::Simulation with_interface_axes(const pattern::Layout& layout, double anisotropy, double orientation_deg) {
  tester::Simulation simulation = specimen(layout);
  simulation.parameters.extensions["interface_anisotropy"] = {anisotropy};
  simulation.conditions.orientation_deg = orientation_deg;
  return simulation;
}

// Exact: one unit of the transposed layout with exchanged interface axes is the transposed grid, element by element,
// for both testers.
TEST(FractureSymmetry, TransposingLayoutAndInterfaceAxesTransposesTheGrid) {
  // Rows count from the bottom, so that the grid's diagonal is the layout's other one: transpose, and turn by half.
  const pattern::Layout layout = lopsided_layout(), transposed = layout.transposed().rotated().rotated();
  ASSERT_NE(layout, transposed);
  for (const auto target : {tester::AssemblyTarget::modulus, tester::AssemblyTarget::toughness}) {
    const auto unit = [&](const pattern::Layout& l, double anisotropy) {
      const tester::Simulation simulation = with_interface_axes(l, anisotropy, 0.0);
      return tester::assemble(l, simulation.parameters, {}, target, 1, 1);
    };
    const fem::Grid a = unit(layout, 0.25), b = unit(transposed, -0.25);
    for (int row = 0; row < a.rows; ++row)
      for (int column = 0; column < a.columns; ++column) {
        ASSERT_EQ(a.phase[a.index(row, column)], b.phase[b.index(column, row)]);
        ASSERT_EQ(a.young_pa[a.index(row, column)], b.young_pa[b.index(column, row)]);
        ASSERT_EQ(a.poisson[a.index(row, column)], b.poisson[b.index(column, row)]);
        ASSERT_EQ(a.threshold_j_per_m3[a.index(row, column)], b.threshold_j_per_m3[b.index(column, row)]);
      }
  }
}

// Exact: printed turned by 90 degrees, outline and layout, is the same specimen with exchanged interface axes, in E, T
// and the whole curve; and it is not the specimen that was not turned.
TEST(FractureSymmetry, PrintedTurnedIsTheLayoutWithExchangedInterfaceAxes) {
  const pattern::Layout layout = lopsided_layout();
  const tester::Simulation turned = with_interface_axes(layout, 0.25, 90.0),
                           exchanged = with_interface_axes(layout, -0.25, 0.0),
                           upright = with_interface_axes(layout, 0.25, 0.0);
  EXPECT_EQ(tester::test_modulus(turned).value().modulus_pa, tester::test_modulus(exchanged).value().modulus_pa);
  EXPECT_NE(tester::test_modulus(turned).value().modulus_pa, tester::test_modulus(upright).value().modulus_pa);
  const tester::ToughnessResult a = tester::test_toughness(turned).value(),
                                b = tester::test_toughness(exchanged).value();
  EXPECT_EQ(a.toughness_pa, b.toughness_pa);
  EXPECT_EQ(a.curve, b.curve);
  EXPECT_NE(a.toughness_pa, tester::test_toughness(upright).value().toughness_pa);
}

}  // namespace
}  // namespace nacre
