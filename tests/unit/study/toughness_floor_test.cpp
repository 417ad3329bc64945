// The floor of single fracture tests and of means over specimens, from tables whose deviations are known.

#include "discretisation_floor/toughness_floor.hpp"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "pattern/random_pattern.hpp"

namespace nacre::discretisation_floor {
namespace {

/// Standard deviations of log T(h/2) / T(h): of a design, and of a specimen about its design.
struct Deviations {
  double design = 0.0, specimen = 0.0;
};

/// A table of fracture tests of a plan, in a file of its own.
class ToughnessFloorOf : public testing::Test {
 protected:
  static FloorPlan plan_of_specimens(int specimens) {
    RandomStream random(1, "toughness floor test");
    return {.layouts = pattern::stratified_patterns(400, random),
            .sets = floor_parameter_sets(1, 1),
            .sets_per_layout = 1,
            .specimens = specimens};
  }

  ToughnessFloor floor_of(const FloorPlan& plan, const Deviations& truth, double shift) {
    std::filesystem::remove(file_);
    study::StudyTable table(file_, kToughnessColumns);
    RandomStream random(2, "toughness floor test");
    for (std::size_t i = 0; i < plan.layouts.size(); ++i) {
      const double departure = shift + truth.design * random.normal();
      for (int k = 0; k < plan.specimens; ++k) {
        const double change = departure + truth.specimen * random.normal();
        table.add(toughness_key(plan, i, 0, 1, k), {1e5, 1e6, 0.05});
        table.add(toughness_key(plan, i, 0, 2, k), {1e5 * std::exp(change), 1e6 * std::exp(0.5 * change), 0.05});
      }
    }
    ModulusFloor moduli;
    moduli.residuals = {std::vector<double>(plan.layouts.size(), 0.0)};
    return toughness_floor(plan, table, moduli);
  }

  const std::string file_ = (std::filesystem::temp_directory_path() / "nacre_toughness_floor_test.csv").string();
};

TEST_F(ToughnessFloorOf, SingleSpecimensHasTheirLotteryInIt) {
  const ToughnessFloor floor = floor_of(plan_of_specimens(1), {.design = 0.06, .specimen = 0.08}, 0.3);
  EXPECT_EQ(floor.pairs, 400);
  EXPECT_NEAR(floor.mean[1], 0.3, 0.02);
  EXPECT_NEAR(floor.sd[1], 0.1, 0.01);
  EXPECT_EQ(floor.of_finite_n(1, 1), 0.0);
}

TEST_F(ToughnessFloorOf, MeansOverSpecimensIsThatOfTheDesignAlone) {
  const ToughnessFloor floor = floor_of(plan_of_specimens(4), {.design = 0.06, .specimen = 0.08}, 0.3);
  EXPECT_NEAR(floor.sd[1], 0.06, 0.006);
  EXPECT_NEAR(floor.sd[2], 0.03, 0.003) << "of the peak";
  EXPECT_NEAR(std::sqrt(floor.of_finite_n(1, 1)), 0.04, 0.004);
  EXPECT_NEAR(std::sqrt(floor.layout(1, 1)), 0.06, 0.006);
}

TEST_F(ToughnessFloorOf, DesignsThatDoNotDifferHasNoNegativeVariance) {
  const ToughnessFloor floor = floor_of(plan_of_specimens(4), {.design = 0.0, .specimen = 0.08}, 0.0);
  EXPECT_GE(floor.sd[1], 0.0);
  EXPECT_LT(floor.sd[1], 0.02);
  EXPECT_GE(floor.layout.selfadjointView<Eigen::Upper>().eigenvalues().minCoeff(), -1e-15);
}

TEST_F(ToughnessFloorOf, ADesignWhoseSecondSpecimenFailedIsCountedAsFailed) {
  FloorPlan plan = plan_of_specimens(2);
  std::filesystem::remove(file_);
  study::StudyTable table(file_, kToughnessColumns);
  for (std::size_t i = 0; i < plan.layouts.size(); ++i)
    for (int k = 0; k < 2; ++k)
      for (const int refinement : {1, 2})
        table.add(toughness_key(plan, i, 0, refinement, k),
                  {i == 7 && k == 1 && refinement == 2 ? 0.0 : 1e5, 1e6, 0.05});
  ModulusFloor moduli;
  moduli.residuals = {std::vector<double>(plan.layouts.size(), 0.0)};
  const ToughnessFloor floor = toughness_floor(plan, table, moduli);
  EXPECT_EQ(floor.pairs, 399);
  EXPECT_EQ(floor.failed, 1);
}

}  // namespace
}  // namespace nacre::discretisation_floor
