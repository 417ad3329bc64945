#include "sysid/base_fit.hpp"

#include <gtest/gtest.h>

namespace nacre::sysid {
namespace {

constexpr double kMeasured = 54335.0;  // soft material of Table 3.4, Pa

/// A material whose crack arrests beyond W / E = 0.05: toughness jumps by a half there, as the soft material's does.
double jumping_toughness_pa(const MaterialTrial& trial) {
  const double ratio = trial.w_j_per_m3 / trial.e_pa;
  return trial.e_pa * ratio * (ratio < 0.0505 ? 1.03 : 1.5);
}

TEST(MaterialFit, ScalesModulusAndThresholdTogetherWhereToughnessJumpsAcrossTheMeasuredValue) {
  measurement::Replicates measured;
  measured.design = pattern::Mixture{0.0};
  measured.toughness_count = 4;
  measured.toughness_pa = kMeasured;
  const MaterialRanges ranges = {
      .e = {"e_tb_pa", 1e5, 2e6}, .w = {"w_tb_j_per_m3", 5e4, 1e6}, .gamma = {"gamma_per_s", 2e4, 4e6}};
  MaterialFit fit(measured, ranges, {.e_pa = 1.0094e6, .w_j_per_m3 = 2.236e5, .gamma_per_s = 2.8e5}, 60);
  int simulations = 0;
  while (!fit.finished()) {
    for (const MaterialTrial& trial : fit.ask(3)) {
      Prediction prediction;
      prediction.toughness_pa = jumping_toughness_pa(trial);
      fit.tell(trial, prediction);
      ++simulations;
    }
  }
  EXPECT_TRUE(fit.met());
  EXPECT_NEAR(fit.best().w_j_per_m3 / fit.best().e_pa, 0.0505, 0.0015);
  EXPECT_LT(simulations, 30);
}

}  // namespace
}  // namespace nacre::sysid
