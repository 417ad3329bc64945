#include "diagnosis/smoothing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "diagnosis/features.hpp"

namespace nacre::diagnosis {
namespace {

/// A coupon that bends over, pulled to 2 % strain, back to 0.5 % and on to 2.2 %: `readings` of each way.
tester::Curve coupon(int readings, double noise_pa, RandomStream& random) {
  constexpr double kYoungPa = 1e9, kUnloadingPa = 1.1e9, kBendPa = 3e7;
  tester::Curve curve;
  const auto loading = [&](double strain) { return kBendPa * std::tanh(kYoungPa * strain / kBendPa); };
  const auto add = [&](double strain, double stress_pa) {
    curve.strain.push_back(strain);
    curve.stress_pa.push_back(stress_pa + noise_pa * random.normal());
  };
  for (int i = 0; i <= readings; ++i) add(0.02 * i / readings, loading(0.02 * i / readings));
  for (int i = 1; i <= readings; ++i) {
    const double back = 0.015 * i / readings;
    add(0.02 - back, loading(0.02) - kUnloadingPa * back);
  }
  return curve;
}

TEST(Smoothing, LeavesCurvesThatDoNotScatterAndShortOnesAlone) {
  RandomStream random(1, "smoothing");
  tester::Curve line;
  for (int i = 0; i < 500; ++i) line.strain.push_back(1e-4 * i), line.stress_pa.push_back(1e5 * i - 40.0 * i * i);
  EXPECT_EQ(smoothed(line, {}), line);
  tester::Curve brief;
  for (int i = 0; i < 100; ++i)
    brief.strain.push_back(1e-4 * i), brief.stress_pa.push_back(1e5 * i + 1e5 * random.normal());
  EXPECT_EQ(smoothed(brief, {}), brief);
}

TEST(Smoothing, FollowsTheCurveUnderTheReadings) {
  RandomStream random(2, "smoothing");
  tester::Curve noisy;
  const auto truth = [](double strain) { return 3e7 * std::tanh(strain * 1e9 / 3e7); };
  for (int i = 0; i <= 3000; ++i) {
    const double strain = 0.1 * i / 3000.0;
    noisy.strain.push_back(strain);
    noisy.stress_pa.push_back(truth(strain) + 3e5 * random.normal());
  }
  const tester::Curve smooth = smoothed(noisy, {});
  EXPECT_LE(smooth.size(), 65u);
  for (std::size_t k = 0; k < smooth.size(); ++k)
    EXPECT_NEAR(smooth.stress_pa[k], truth(smooth.strain[k]), 3e5) << smooth.strain[k];
}

// The bias is that of every replicate: only a mean over many shows it.
TEST(Smoothing, FeaturesOfNoisyCouponsAreThoseOfTheCurveInTheMean) {
  RandomStream random(3, "smoothing");
  struct Machine {
    int readings;
    double noise_pa, tolerance;
  };
  for (const auto& [readings, noise_pa, tolerance] :
       {Machine{1000, 1e5, 0.005}, Machine{3000, 1.5e5, 0.005}, Machine{1000, 1e6, 0.02}}) {
    const FeatureValues exact = tensile_features(coupon(readings, 0.0, random), {});
    constexpr int kCoupons = 60;
    FeatureValues sum;
    for (int i = 0; i < kCoupons; ++i) {
      const FeatureValues each = tensile_features(coupon(readings, noise_pa, random), {});
      for (std::size_t f = 0; f < each.size(); ++f)
        if (each[f]) sum[f] = sum[f].value_or(0.0) + *each[f] / kCoupons;
    }
    for (const Feature feature : {Feature::log_tangent_10, Feature::log_tangent_30, Feature::log_tangent_50,
                                  Feature::log_peak, Feature::knee, Feature::log_unloading}) {
      ASSERT_TRUE(value_of(sum, feature) && value_of(exact, feature)) << to_string(feature);
      EXPECT_NEAR(*value_of(sum, feature), *value_of(exact, feature), tolerance)
          << to_string(feature) << " of " << readings << " readings that scatter by " << noise_pa;
    }
  }
}

}  // namespace
}  // namespace nacre::diagnosis
