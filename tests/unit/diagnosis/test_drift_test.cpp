#include "diagnosis/test_drift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "made_specimens.hpp"

namespace nacre::diagnosis {
namespace {

/// Nine specimens at each of three rates, whose turns on the machine are mixed; twice as stiff when fast.
std::vector<measurement::SpecimenRecord> tested_in_turn(double growth_per_test, bool is_sorted) {
  std::vector<Made> all;
  for (const double rate : {1e-3, 1e-2, 1e-1})
    for (int r = 0; r < 3; ++r) all.push_back({1.0, rate});
  std::vector<measurement::SpecimenRecord> specimens =
      specimens_of(all, [](const Made& made) { return std::pow(made.rate_per_s / 1e-3, 0.15); });
  const int count = static_cast<int>(specimens.size());
  for (int i = 0; i < count; ++i) {
    const int order = is_sorted ? i : (7 * i) % count;
    specimens[i].other_columns["test_order"] = std::to_string(order + 1);
    specimens[i].other_columns["machine"] = "old";
    *specimens[i].modulus_pa *= std::exp(growth_per_test * order);
  }
  return specimens;
}

TEST(TestDrift, IsSeenWhereAllElseIsEqual) {
  const std::vector<TestDrift> drifts = test_drifts(tested_in_turn(0.01, false));
  ASSERT_EQ(drifts.size(), 1u);
  EXPECT_EQ(drifts.front().tests, 27);
  EXPECT_NEAR(drifts.front().ratio, std::exp(0.26), 0.06);
  EXPECT_LT(drifts.front().low, std::exp(0.26));
  EXPECT_GT(drifts.front().high, std::exp(0.26));
  EXPECT_NE(in_words(drifts).find("of the machine \"old\" drift"), std::string::npos) << in_words(drifts);
}

// The slow ones first: what the rate does is no drift.
TEST(TestDrift, WhatARateDoesIsNone) {
  const std::vector<TestDrift> drifts = test_drifts(tested_in_turn(0.0, true));
  ASSERT_EQ(drifts.size(), 1u);
  EXPECT_GT(drifts.front().chance, 0.01);
  EXPECT_TRUE(in_words(drifts).empty()) << in_words(drifts);
}

TEST(TestDrift, NeedsTheOrder) {
  std::vector<measurement::SpecimenRecord> specimens = tested_in_turn(0.01, false);
  for (measurement::SpecimenRecord& specimen : specimens) specimen.other_columns.erase("test_order");
  EXPECT_TRUE(test_drifts(specimens).empty());
}

}  // namespace
}  // namespace nacre::diagnosis
