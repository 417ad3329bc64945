#include "fem/frontal_cholesky.hpp"

#include <gtest/gtest.h>

#include "../../grids.hpp"
#include "fem/element.hpp"

namespace nacre::fem {
namespace {

std::size_t unknown_count(const Grid& grid) {
  return static_cast<std::size_t>(2 * (grid.columns + 1) * (grid.rows + 1));
}

/// Bottom row of nodes held in both directions.
std::vector<char> bottom_held(const Grid& grid) {
  std::vector<char> held(unknown_count(grid), 0);
  std::fill_n(held.begin(), 2 * (grid.columns + 1), 1);
  return held;
}

/// K x on the free unknowns, x being zero on the held ones.
std::vector<double> product(const Grid& grid, const std::vector<char>& held, const std::vector<double>& x) {
  const std::vector<material::Lame> lame = lame_of(grid);
  std::vector<double> result(x.size(), 0.0);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const material::Lame& constants = lame[grid.index(row, column)];
      const ElementMatrix stiffness =
          constants.mu_pa * unit_stiffness().shear + constants.lambda_pa * unit_stiffness().bulk;
      const auto nodes = element_nodes(grid, row, column);
      const auto unknown = [&](int a) { return static_cast<std::size_t>(2 * nodes[a / 2] + a % 2); };
      for (int a = 0; a < 8; ++a)
        for (int b = 0; b < 8; ++b)
          if (!held[unknown(a)] && !held[unknown(b)]) result[unknown(a)] += stiffness(a, b) * x[unknown(b)];
    }
  return result;
}

TEST(Dissection, EliminatesEveryFreeUnknownOnceAndPlacesEveryElementOnce) {
  for (const auto& [columns, rows] : {std::pair{1, 1}, {7, 3}, {40, 40}, {3, 29}}) {
    const Grid grid = uniform_grid(columns, rows);
    const std::vector<char> held = bottom_held(grid);
    const DissectionPlan plan = dissect(grid, held);
    std::vector<int> eliminated(held.size(), 0), placed(grid.phase.size(), 0);
    for (const DissectionBlock& block : plan.blocks) {
      for (const int unknown : block.pivots) ++eliminated[unknown];
      for (const int element : block.elements) ++placed[element];
    }
    for (std::size_t i = 0; i < held.size(); ++i) EXPECT_EQ(eliminated[i], held[i] ? 0 : 1);
    EXPECT_EQ(std::count(placed.begin(), placed.end(), 1), grid.element_count());
    EXPECT_TRUE(plan.blocks.back().border.empty());
  }
}

TEST(FrontalCholesky, SolvesWhatTheElementsSay) {
  for (const auto& [columns, rows] : {std::pair{1, 1}, {7, 3}, {24, 31}}) {
    const Grid grid = random_grid(columns, rows);
    const std::vector<char> held = bottom_held(grid);
    FrontalCholesky factorisation(std::make_shared<const DissectionPlan>(dissect(grid, held)));
    RandomStream random(2, "frontal_cholesky_test");
    std::vector<double> exact(held.size(), 0.0);
    for (std::size_t i = 0; i < exact.size(); ++i)
      if (!held[i]) exact[i] = random.uniform(-1.0, 1.0);
    for (int again = 0; again < 2; ++again) {  // its memory is used anew
      ASSERT_TRUE(factorisation.factorise(lame_of(grid)));
      std::vector<double> x = product(grid, held, exact);
      factorisation.solve(x);
      for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(held[i] ? 0.0 : x[i], exact[i], 1e-8);
    }
  }
}

TEST(FrontalCholesky, InstructionSetsGiveTheSameBits) {
  const Grid grid = random_grid(24, 31);
  const std::vector<char> held = bottom_held(grid);
  const auto plan = std::make_shared<const DissectionPlan>(dissect(grid, held));
  RandomStream random(3, "frontal_cholesky_test");
  std::vector<double> load(held.size());
  for (double& force : load) force = random.uniform(-1.0, 1.0);
  std::vector<std::vector<double>> solutions;
  for (const SimdLevel level : {SimdLevel::baseline, SimdLevel::avx2, SimdLevel::avx512}) {
    if (!has_simd_level(level)) continue;
    FrontalCholesky factorisation(plan, level);
    ASSERT_TRUE(factorisation.factorise(lame_of(grid)));
    solutions.push_back(load);
    factorisation.solve(solutions.back());
    EXPECT_EQ(solutions.back(), solutions.front()) << to_string(level);
  }
}

TEST(FrontalCholesky, RefusesWhatCanMoveFreely) {
  Grid grid = uniform_grid(8, 8);
  for (int column = 0; column < 8; ++column)
    for (const int row : {3}) grid.phase[grid.index(row, column)] = Phase::empty;
  const std::vector<char> held = bottom_held(grid);
  FrontalCholesky factorisation(std::make_shared<const DissectionPlan>(dissect(grid, held)));
  EXPECT_FALSE(factorisation.factorise(lame_of(grid)));
}

}  // namespace
}  // namespace nacre::fem
