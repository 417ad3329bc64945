// Effects of the discretisation of the toughness tester: number type, time step, recording. Medians over 20 patterns,
// because which element fails first may turn on the last bit; single specimens may differ by more
// (docs/studies/repeatability.md).

#include <gtest/gtest.h>

#include "specimens.hpp"

namespace nacre {
namespace {

using verification::median;
using verification::patterns;
using verification::specimen;
using verification::toughness_differences;

constexpr int kPatterns = 20;

// Median difference of T below 1 %.
TEST(FractureDiscretisation, SingleAndDoublePrecisionAgree) {
  const std::vector<double> differences = toughness_differences(
      patterns(kPatterns), [](const auto& s) { return tester::run_fracture_test<float>(tester::fracture_test(s)); },
      [](const auto& s) { return tester::run_fracture_test<double>(tester::fracture_test(s)); });
  EXPECT_LT(median(differences), 0.01);
}

// Median change of T below 2 %.
TEST(FractureDiscretisation, HalfTheTimeStepChangesLittle) {
  const std::vector<double> differences = toughness_differences(
      patterns(kPatterns), [](const auto& s) { return tester::test_toughness(s); },
      [](const auto& s) { return tester::test_toughness(s, {.time_step_scale = 0.5}); });
  EXPECT_LT(median(differences), 0.02);
}

// T is the area under the stress of every step, which recording cannot change (exact); the recorded curve's own area
// stays within 0.1 % of it, with as many samples as usual and with twice as many.
TEST(FractureDiscretisation, DoubledRecordingChangesToughnessByLessThanAThousandth) {
  for (const pattern::Design& design : patterns(5)) {
    const auto once = tester::test_toughness(specimen(design)).value();
    const auto twice = tester::test_toughness(specimen(design), {.recording_scale = 2}).value();
    EXPECT_GT(twice.curve.size(), once.curve.size() * 9 / 5);
    EXPECT_NEAR(area_under(twice.curve) / area_under(once.curve), 1.0, 1e-3);
    EXPECT_NEAR(area_under(once.curve) / once.toughness_pa, 1.0, 1e-3);
    EXPECT_EQ(once.toughness_pa, twice.toughness_pa);
  }
}

}  // namespace
}  // namespace nacre
