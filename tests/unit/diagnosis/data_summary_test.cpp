#include "diagnosis/data_summary.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "measurement/piece.hpp"

namespace nacre::diagnosis {
namespace {

using measurement::SpecimenRecord;

SpecimenRecord modulus_of(const std::string& name, double rigid_share, double modulus_pa) {
  SpecimenRecord record;
  record.specimen = name;
  record.design = pattern::Mixture{rigid_share};
  record.modulus_pa = modulus_pa;
  return record;
}

DataSummary summary(const std::vector<SpecimenRecord>& specimens) { return summary_of_data(specimens, NoiseRules{}); }

const ConditionTrend& trend_with(const DataSummary& data, const std::string& condition) {
  for (const ConditionTrend& trend : data.trends)
    if (trend.condition == condition) return trend;
  throw std::runtime_error("no trend with " + condition);
}

TEST(DataSummary, MeansHaveTheIntervalOfStudent) {
  const DataSummary data = summary({modulus_of("a", 1.0, 1e9 * std::exp(0.1)), modulus_of("b", 1.0, 1e9),
                                    modulus_of("c", 1.0, 1e9 / std::exp(0.1))});
  ASSERT_EQ(data.means.size(), 1u);
  EXPECT_EQ(data.means[0].pieces, 3);
  EXPECT_NEAR(data.means[0].mean_pa, 1e9, 1.0);
  EXPECT_NEAR(data.means[0].scatter, 0.1, 1e-12);
  EXPECT_NEAR(std::log(data.means[0].high_pa / 1e9), 2.920 * 0.1 / std::sqrt(3.0), 1e-4) << "t of two degrees";
  EXPECT_TRUE(data.trends.empty());
}

// 25 and 26 degrees are one room, 60 degrees is an oven.
TEST(DataSummary, MeansAreThoseOfOneTemperature) {
  std::vector<SpecimenRecord> specimens;
  for (const char* temperature : {"25", "26", "60"}) {
    specimens.push_back(modulus_of(temperature, 1.0, std::string(temperature) == "60" ? 2e8 : 1e9));
    specimens.back().other_columns["temperature_c"] = temperature;
  }
  const DataSummary data = summary(specimens);
  ASSERT_EQ(data.means.size(), 2u);
  EXPECT_EQ(data.means[0].pieces, 2);
  EXPECT_NEAR(data.means[0].mean_pa, 1e9, 1.0);
  EXPECT_EQ(data.means[1].surroundings.temperature_c, 60.0);
  EXPECT_NEAR(data.means[1].mean_pa, 2e8, 1.0);
}

// E grows as the rate to the power 0.2 in one material and not at all in another.
TEST(DataSummary, RatesHaveAnExponentOfEachMaterial) {
  RandomStream noise(3, "test");
  std::vector<SpecimenRecord> specimens;
  for (const double rate : {1e-4, 1e-3, 1e-2}) {
    for (int i = 0; i < 4; ++i) {
      for (const double share : {0.0, 1.0}) {
        specimens.push_back(
            modulus_of(std::to_string(specimens.size()), share,
                       1e8 * (share > 0.0 ? 1.0 : std::pow(rate, 0.2)) * std::exp(0.03 * noise.normal())));
        specimens.back().conditions.strain_rate_per_s = rate;
      }
    }
  }
  const DataSummary data = summary(specimens);
  ASSERT_EQ(data.trends.size(), 2u);
  const ConditionTrend &soft = data.trends[0], &rigid = data.trends[1];
  EXPECT_EQ(soft.of, "soft");
  EXPECT_LT(soft.exponent_low, 0.2);
  EXPECT_GT(soft.exponent_high, 0.2);
  EXPECT_LT(soft.exponent_high - soft.exponent_low, 0.03);
  EXPECT_NEAR(soft.ratio, std::pow(100.0, soft.exponent), 1e-9);
  EXPECT_LT(soft.chance, 1e-6);
  EXPECT_LT(rigid.exponent_low, 0.0);
  EXPECT_GT(rigid.exponent_high, 0.0);
}

// Pieces differ by half; each was swept over temperature, and what changes within it is known to 1 %.
TEST(DataSummary, WhatChangesWithinPiecesIsFreeOfTheirScatter) {
  RandomStream noise(4, "test");
  std::vector<SpecimenRecord> specimens;
  for (int piece = 0; piece < 3; ++piece) {
    for (const double temperature : {0.0, 20.0, 40.0}) {
      specimens.push_back(
          modulus_of(std::to_string(specimens.size()), 1.0,
                     1e9 * (1.0 + 0.5 * piece) * std::exp(-0.01 * temperature + 0.005 * noise.normal())));
      specimens.back().other_columns = {{"sample", std::to_string(piece)},
                                        {"temperature_c", std::to_string(temperature)}};
    }
  }
  const DataSummary data = summary(specimens);
  ASSERT_EQ(data.trends.size(), 1u) << "the column of pieces is no condition";
  EXPECT_EQ(data.trends[0].condition, "temperature_c");
  EXPECT_EQ(data.trends[0].pieces, 3);
  EXPECT_NEAR(data.trends[0].ratio, std::exp(-0.4), 0.02);
  EXPECT_LT(data.trends[0].high - data.trends[0].low, 0.03);
  EXPECT_EQ(data.means[0].pieces, 3) << "nine tests of three pieces";
}

TEST(DataSummary, MachinesAreComparedByTheirNames) {
  std::vector<SpecimenRecord> specimens;
  for (int i = 0; i < 4; ++i) {
    for (const char* machine : {"old", "new"}) {
      specimens.push_back(
          modulus_of(std::to_string(specimens.size()), 1.0, 1e9 * (machine[0] == 'o' ? 1.1 : 1.0) * (1.0 + 0.002 * i)));
      specimens.back().other_columns["machine"] = machine;
    }
  }
  const ConditionTrend& trend = trend_with(summary(specimens), "machine");
  EXPECT_EQ(trend.from, "new");
  EXPECT_EQ(trend.to, "old");
  EXPECT_NEAR(trend.ratio, 1.1, 1e-9);
  EXPECT_LT(trend.chance, 0.01);
}

// What scatter alone does is seldom a trend: the chance of all of them together is kept.
TEST(DataSummary, ScatterIsNoTrend) {
  int found = 0;
  constexpr int kSets = 200;
  for (int set = 0; set < kSets; ++set) {
    RandomStream noise(set, "test");
    std::vector<SpecimenRecord> specimens;
    for (int i = 0; i < 12; ++i) {
      specimens.push_back(modulus_of(std::to_string(i), 1.0, 1e9 * std::exp(0.1 * noise.normal())));
      specimens.back().conditions.thickness_mm = i % 2 == 0 ? 1.6 : 3.2;
      specimens.back().conditions.strain_rate_per_s = i % 3 == 0 ? 1e-3 : 1e-1;
      specimens.back().batch = i % 4 < 2 ? "a" : "b";
    }
    const DataSummary data = summary(specimens);
    ASSERT_EQ(data.trends.size(), 3u);
    found += data.trends.front().chance < 0.05;
  }
  EXPECT_GE(found, 1) << "one in twenty";
  EXPECT_LE(found, 20);
}

}  // namespace
}  // namespace nacre::diagnosis
