#include "fem/static_solver.hpp"

#include <gtest/gtest.h>

#include "../../grids.hpp"
#include "fem/element.hpp"

namespace nacre::fem {
namespace {

// The patch test: a homogeneous grid carries a linear displacement field, and the stress of the material point.
TEST(StaticSolver, HomogeneousGridIsAMaterialPointAtAnyStrain) {
  const Grid grid = uniform_grid(13, 9);
  const material::Lame lame = lame_of(grid).front();
  for (const double strain : {-0.01, 1e-4, 0.01, 0.1}) {
    const Result<StaticSolution> solution = pull(grid, strain);
    ASSERT_TRUE(solution) << solution.error().message;
    const material::UniaxialState point = material::uniaxial_stress(strain, lame);
    EXPECT_NEAR(solution->top_stress_pa / point.nominal_stress_pa, 1.0, 1e-10);
    for (int row = 0; row <= grid.rows; ++row)
      for (int column = 0; column <= grid.columns; ++column) {
        const auto unknown = static_cast<std::size_t>(2 * (row * (grid.columns + 1) + column));
        EXPECT_NEAR(solution->displacement[unknown], (point.lateral_stretch - 1.0) * column,
                    1e-9 * std::abs(strain) * 13);
        EXPECT_NEAR(solution->displacement[unknown + 1], strain * row, 1e-9 * std::abs(strain) * 13);
      }
  }
}

TEST(StaticSolver, BothGripsFeelTheSameForce) {
  const Result<StaticSolution> solution = pull(random_grid(20, 30), 1e-4);
  ASSERT_TRUE(solution) << solution.error().message;
  EXPECT_NEAR(solution->top_stress_pa / solution->bottom_stress_pa, 1.0, 1e-9);
  EXPECT_LT(solution->relative_residual, 1e-10);
}

TEST(StaticSolver, EmptyElementsCarryNothing) {
  Grid grid = uniform_grid(10, 6);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < 4; ++column) grid.phase[grid.index(row, column)] = Phase::empty;
  const Result<StaticSolution> whole = pull(uniform_grid(10, 6), 1e-4), part = pull(grid, 1e-4);
  ASSERT_TRUE(whole && part);
  EXPECT_NEAR(part->top_stress_pa / whole->top_stress_pa, 0.6, 1e-10);
}

TEST(StaticSolver, RepeatsItselfToTheBitWhateverWasSolvedBefore) {
  const Grid grid = random_grid(16, 12);
  const Result<StaticSolution> first = pull(grid, 1e-4);
  (void)pull(uniform_grid(9, 9), 1e-4);
  Grid notched = grid;
  notched.phase[0] = Phase::empty;
  (void)pull(notched, 1e-4);
  const Result<StaticSolution> second = pull(grid, 1e-4);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->displacement, second->displacement);
  EXPECT_EQ(first->top_stress_pa, second->top_stress_pa);
}

TEST(StaticSolver, AnImpossibleStrainIsAnError) {
  EXPECT_FALSE(pull(uniform_grid(4, 4), 0.6));
  EXPECT_FALSE(pull(uniform_grid(4, 4), std::nan("")));
}

TEST(StaticSolver, ATornGridIsAnError) {
  Grid grid = uniform_grid(6, 6);
  for (int column = 0; column < 6; ++column)
    for (const int row : {1, 4}) grid.phase[grid.index(row, column)] = Phase::empty;
  const Result<StaticSolution> solution = pull(grid, 1e-4);
  ASSERT_FALSE(solution);
  EXPECT_NE(solution.error().message.find("not supported"), std::string::npos);
}

}  // namespace
}  // namespace nacre::fem
