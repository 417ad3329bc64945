// The floor of the expected T, from draws whose deviations are known.

#include "discretisation_floor/expectation_floor.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.hpp"

namespace nacre::discretisation_floor {
namespace {

struct Truth {
  double floor_sd = 0.0, shift = 0.0, scatter = 0.1;
  double shared = 0.0;  ///< share of the scatter's variance that both meshes have in common
};

std::vector<DesignPair> draw(const Truth& truth, int designs, int coarse, int fine) {
  RandomStream random(1, "expectation floor test");
  std::vector<DesignPair> pairs;
  for (int i = 0; i < designs; ++i) {
    const double level = 0.3 * random.normal(), departure = truth.shift + truth.floor_sd * random.normal();
    DesignPair pair{.set = static_cast<std::size_t>(i % 2), .coarse_pa = {}, .fine_pa = {}, .log_peak_ratio = 0.0};
    for (int k = 0; k < std::max(coarse, fine); ++k) {
      const double common = std::sqrt(truth.shared) * random.normal(), own = std::sqrt(1.0 - truth.shared);
      const double on_coarse = common + own * random.normal(), on_fine = common + own * random.normal();
      if (k < coarse) pair.coarse_pa.push_back(1e5 * std::exp(level) * (1.0 + truth.scatter * on_coarse));
      if (k < fine) pair.fine_pa.push_back(1e5 * std::exp(level + departure) * (1.0 + truth.scatter * on_fine));
    }
    pairs.push_back(pair);
  }
  return pairs;
}

TEST(ExpectationFloor, TakesOffWhatTheFiniteNumberOfSpecimensMakes) {
  for (const double shared : {0.0, 0.8}) {
    const Truth truth{.floor_sd = 0.05, .shift = 0.3, .shared = shared};
    const ExpectationFloor floor = expectation_floor(draw(truth, 4000, 6, 3));
    EXPECT_NEAR(floor.shift, 0.3, 0.01);
    EXPECT_NEAR(floor.finite_n_sd, 0.1 * std::sqrt(1.0 / 6 + 1.0 / 3 - 2.0 * shared / 6), 0.002);
    EXPECT_NEAR(floor.expected_sd, 0.05, 0.004);
    EXPECT_NEAR(floor.same_crack, shared, 0.04);
    EXPECT_NEAR(floor.coarse_scatter, 0.1, 0.002);
    EXPECT_NEAR(floor.one_sd, std::sqrt(0.05 * 0.05 + 2.0 * (1.0 - shared) * 0.01), 0.004);
  }
}

TEST(ExpectationFloor, OfEqualMeshesIsNone) {
  std::vector<DesignPair> pairs = draw({}, 20, 4, 4);
  for (DesignPair& pair : pairs) pair.fine_pa = pair.coarse_pa;
  const ExpectationFloor floor = expectation_floor(pairs);
  EXPECT_NEAR(floor.sd, 0.0, 1e-12);
  EXPECT_NEAR(floor.finite_n_sd, 0.0, 1e-7);
  EXPECT_DOUBLE_EQ(floor.spearman, 1.0);
  EXPECT_NEAR(floor.same_crack, 1.0, 1e-12);
}

TEST(ExpectationFloor, HasAFactorPerParameterSet) {
  std::vector<DesignPair> pairs = draw({.scatter = 0.0}, 20, 2, 2);
  for (DesignPair& pair : pairs)
    for (double& value_pa : pair.fine_pa) value_pa *= pair.set == 0 ? 1.5 : 0.9;
  EXPECT_EQ(expectation_floor(pairs).peak_share, 0.0);
  const ExpectationFloor floor = expectation_floor(pairs);
  EXPECT_NEAR(floor.sd, 0.0, 1e-12);
  EXPECT_NEAR(floor.shift, 0.5 * std::log(1.5 * 0.9), 1e-12);
}

TEST(ExpectationFloor, SaysWhatTheChangeOfPeaksExplains) {
  RandomStream random(2, "expectation floor test");
  std::vector<DesignPair> pairs = draw({.floor_sd = 0.1, .scatter = 0.0}, 2000, 2, 2);
  for (DesignPair& pair : pairs)
    pair.log_peak_ratio = 0.2 + 0.5 * (std::log(pair.fine_pa[0] / pair.coarse_pa[0]) + 0.1 * random.normal());
  EXPECT_NEAR(expectation_floor(pairs).peak_share, 0.5, 0.04);
}

TEST(ExpectationFloor, TableHasIntervalsAroundItsFigures) {
  const std::vector<DesignPair> pairs = draw({.floor_sd = 0.05, .shift = 0.3}, 40, 4, 4);
  EXPECT_EQ(expectation_table(pairs, 1), expectation_table(pairs, 1));
  EXPECT_NE(expectation_table(pairs, 1).find("Spearman"), std::string::npos);
  EXPECT_NE(expectation_table(pairs, 1).find("finite number"), std::string::npos);
  EXPECT_EQ(expectation_table(draw({}, 20, 1, 1), 1).find("finite number"), std::string::npos) << "it is not known";
  EXPECT_NE(expectation_table({pairs.begin(), pairs.begin() + 3}, 1).find("fewer"), std::string::npos);
}

}  // namespace
}  // namespace nacre::discretisation_floor
