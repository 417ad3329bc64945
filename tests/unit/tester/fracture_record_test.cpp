#include "tester/fracture_record.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace nacre::tester {
namespace {

constexpr double kStrainStep = 4e-6;
constexpr FractureRecord::Sampling kSampling{
    .strain_per_step = kStrainStep, .steps_per_sample = 25, .transit_steps = 400, .strain_limit = 0.3};

/// Feeds stress(strain) until the record is separated or strain 0.05 is reached; returns the strain at the end.
template <class Stress>
double feed(FractureRecord& record, const Stress& stress) {
  for (int step = 0; step < 12500; ++step) {
    const double strain = step * kStrainStep;
    record.add(strain, stress(strain));
    if (record.separated()) return strain;
  }
  return 0.05;
}

TEST(FractureRecord, SeparationIsSeenAfterTheLoadIsGoneAndCostsNoArea) {
  FractureRecord record(kSampling);
  const double end = feed(record, [](double strain) { return strain < 0.02 ? 1e8 * strain : 0.0; });
  EXPECT_GT(end, 0.02);
  EXPECT_LT(end, 0.02 + 400 * kStrainStep);
  EXPECT_NEAR(record.toughness_pa(), 0.5 * 1e8 * 0.02 * 0.02, 10.0);
  EXPECT_NEAR(record.peak_stress_pa(), 2e6, 0.02 * 2e6);
}

// Full swings of the load between zero and twice its mean, faster than one transit, are no separation.
TEST(FractureRecord, RingingEndsNoTest) {
  FractureRecord record(kSampling);
  const double period = 200 * kStrainStep;
  const double end =
      feed(record, [&](double strain) { return 1e6 * (1.0 + std::cos(2.0 * std::numbers::pi * strain / period)); });
  EXPECT_EQ(end, 0.05);
}

TEST(FractureRecord, CurveHasTheAreaOfEveryStep) {
  for (const int steps_per_sample : {1, 7, 25}) {
    FractureRecord::Sampling sampling = kSampling;
    sampling.steps_per_sample = steps_per_sample;
    FractureRecord record(sampling);
    feed(record, [](double strain) { return strain < 0.02 ? 1e8 * strain * (1.0 - 15.0 * strain) : 0.0; });
    const double toughness = record.toughness_pa();
    const Curve curve = record.take_curve();
    EXPECT_NEAR(area_under(curve) / toughness, 1.0, 1e-3) << steps_per_sample;
    EXPECT_EQ(curve.strain.front(), 0.0);
    EXPECT_TRUE(std::is_sorted(curve.strain.begin(), curve.strain.end()));
  }
}

}  // namespace
}  // namespace nacre::tester
