#include <gtest/gtest.h>

#include "../../grids.hpp"
#include "tester/failure_criterion.hpp"
#include "tester/simulation_key.hpp"
#include "tester/usable.hpp"

namespace nacre::tester {
namespace {

using material::CriterionKind;

TEST(FailureCriterion, HasNames) {
  for (const CriterionKind kind : {CriterionKind::element, CriterionKind::neighbourhood, CriterionKind::crack_band})
    EXPECT_EQ(material::criterion_from_string(to_string(kind)).value(), kind);
  EXPECT_NE(material::criterion_from_string("cohesive").error().message.find("neighbourhood"), std::string::npos);
}

TEST(FailureCriterion, OfTheThesisChangesNothing) {
  fem::Grid grid = fem::uniform_grid(4, 4, {.threshold_j_per_m3 = 6.0});
  set_criterion(grid, 3, {});
  EXPECT_EQ(grid.threshold_j_per_m3[5], 6.0);
  EXPECT_FALSE(grid.laws.any());
  EXPECT_EQ(grid.neighbourhood_m, 0.0);
}

TEST(FailureCriterion, WithALengthKeepsTheThresholdOnEveryMesh) {
  for (const CriterionKind kind : {CriterionKind::neighbourhood, CriterionKind::crack_band}) {
    fem::Grid grid = fem::uniform_grid(4, 4, {.threshold_j_per_m3 = 6.0});
    set_criterion(grid, 2, {.kind = kind});
    EXPECT_EQ(grid.threshold_j_per_m3[5], 3.0);
  }
}

TEST(FailureCriterion, TailIsScaledAndTheEffectAddsToIt) {
  const auto tail = [](CriterionKind kind, double effect, int refinement) {
    fem::Grid grid = fem::uniform_grid(4, 4, {.threshold_j_per_m3 = 6.0});
    grid.laws.softening = effect;
    set_criterion(grid, refinement, {.kind = kind, .softening = 3.0});
    return grid.laws.softening;
  };
  EXPECT_EQ(tail(CriterionKind::crack_band, 0.0, 1), 3.0);
  EXPECT_EQ(tail(CriterionKind::crack_band, 0.0, 2), 7.0);
  EXPECT_EQ(tail(CriterionKind::crack_band, 1.0, 2), 9.0);
  EXPECT_EQ(tail(CriterionKind::neighbourhood, 1.0, 2), 3.0);
  EXPECT_EQ(tail(CriterionKind::neighbourhood, 0.0, 2), 0.0);
  EXPECT_EQ(tail(CriterionKind::element, 1.0, 2), 1.0);
}

Simulation of_rigid() {
  return {.design = pattern::Mixture{1.0}, .parameters = material::thesis_parameters(), .conditions = {}};
}

TEST(FailureCriterion, IsPartOfTheKeyOfAFractureTest) {
  const std::string plain = simulation_key(of_rigid(), TestKind::toughness);
  Simulation other = of_rigid();
  other.parameters.criterion = {.radius_m = 1e-3, .softening = 1.0};
  EXPECT_EQ(simulation_key(other, TestKind::toughness), plain) << "the thesis' criterion has neither";
  for (const CriterionKind kind : {CriterionKind::neighbourhood, CriterionKind::crack_band}) {
    Simulation first = of_rigid(), second = of_rigid();
    first.parameters.criterion.kind = second.parameters.criterion.kind = kind;
    second.parameters.criterion.radius_m *= 2.0, second.parameters.criterion.softening *= 2.0;
    EXPECT_NE(simulation_key(first, TestKind::toughness), plain);
    EXPECT_NE(simulation_key(first, TestKind::toughness), simulation_key(second, TestKind::toughness));
    EXPECT_EQ(simulation_key(first, TestKind::modulus), simulation_key(of_rigid(), TestKind::modulus));
  }
}

TEST(FailureCriterion, OutOfRangeIsAFault) {
  Simulation simulation = of_rigid();
  simulation.parameters.criterion = {.kind = CriterionKind::neighbourhood, .radius_m = 0.0};
  EXPECT_NE(simulation_fault(simulation, TestKind::toughness).find("radius"), std::string::npos);
  EXPECT_EQ(simulation_fault(simulation, TestKind::modulus), "");
  simulation.parameters.criterion = {.kind = CriterionKind::crack_band, .softening = 100.0};
  EXPECT_NE(simulation_fault(simulation, TestKind::toughness).find("softening"), std::string::npos);
  simulation.parameters.criterion.softening = 3.0;
  EXPECT_EQ(simulation_fault(simulation, TestKind::toughness), "");
}

}  // namespace
}  // namespace nacre::tester
