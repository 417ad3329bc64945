#include "diagnosis/carried_part.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "diagnosis/diagnose.hpp"
#include "synthetic_set.hpp"

namespace nacre::diagnosis {
namespace {

DiagnosisSettings settings_of_coupons() {
  DiagnosisSettings settings;
  settings.start = material::thesis_parameters();
  settings.fidelity = tester::Fidelity::tiny;
  return settings;
}

/// Coupons of a laboratory with this much slack, a tenth more or less from one to the next, whose materials bend as no
/// effect of the library lets them: before they end, by 6 %, up or down from one mixture to the next.
std::vector<measurement::SpecimenRecord> bent_coupons(double slack) {
  material::ParameterSet truth = synthetic_truth();
  if (slack > 0.0) truth.extensions["toe_slack"] = {slack};
  std::vector<measurement::SpecimenRecord> specimens = synthetic_coupons(truth, {1e-3, 1e-2}, 3, 0.01, 5);
  RandomStream grips(1, "test/grips");
  for (measurement::SpecimenRecord& specimen : specimens) {
    const double loose = 0.1 * slack * grips.normal();
    const int number = static_cast<int>(std::lround(20.0 * specimen.design.rigid_fraction()));
    const double sign = number % 4 == 0 ? 1.0 : -1.0;
    for (std::size_t i = 0; i < specimen.curve.strain.size(); ++i)
      if (std::abs(specimen.curve.strain[i] - 0.0155) < 0.0025) specimen.curve.stress_pa[i] *= 1.0 + 0.06 * sign;
    for (std::size_t i = 1; i < specimen.curve.strain.size(); ++i) specimen.curve.strain[i] += loose;
  }
  return specimens;
}

TEST(CarriedPart, ASlackInTheToesIsNamedWhateverBendsTheCurvesAbove) {
  const Diagnosis diagnosis = diagnose(bent_coupons(0.002), settings_of_coupons());
  ASSERT_EQ(diagnosis.verdict, Verdict::named) << diagnosis.summary;
  ASSERT_EQ(diagnosis.effects.size(), 1u) << diagnosis.summary;
  EXPECT_EQ(diagnosis.effects.front().name, "toe_slack");
  EXPECT_NEAR(diagnosis.effects.front().parameter, 0.002, 2e-4);
  EXPECT_EQ(diagnosis.finding.reason, Reason::carried_part) << diagnosis.summary;
  EXPECT_FALSE(diagnosis.finding.carriers.empty());
  EXPECT_GT(diagnosis.finding.value, 2.0);
}

TEST(CarriedPart, WithoutSlackTheBendIsUnexplained) {
  const Diagnosis diagnosis = diagnose(bent_coupons(0.0), settings_of_coupons());
  EXPECT_EQ(diagnosis.verdict, Verdict::unexplained) << diagnosis.summary;
}

}  // namespace
}  // namespace nacre::diagnosis
