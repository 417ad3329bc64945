#include "game/plausibility.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tester/modulus.hpp"

namespace nacre::game {
namespace {

using testing::HasSubstr;

/// A straight curve of that slope up to that strain, and down at once.
tester::Curve straight(double slope_pa, double strain) {
  tester::Curve curve;
  for (int i = 0; i <= 50; ++i) {
    curve.strain.push_back(strain * i / 50);
    curve.stress_pa.push_back(slope_pa * curve.strain.back());
  }
  curve.strain.push_back(strain * 1.01);
  curve.stress_pa.push_back(0.0);
  return curve;
}

measurement::SpecimenRecord specimen_of(tester::TestKind test, tester::Curve curve) {
  measurement::SpecimenRecord record;
  record.specimen = "S";
  record.design = *pattern::design_from_name("rigid");
  record.test = test;
  record.curve = std::move(curve);
  return record;
}

TEST(Plausibility, DoubtsUnitsAndNothingElse) {
  const material::ParameterSet model = material::thesis_parameters();
  UnitDoubts units(model, tester::Fidelity::tiny);
  const double modulus_pa =
      tester::test_modulus({*pattern::design_from_name("rigid"), model, {}, tester::Fidelity::tiny})->modulus_pa;
  const auto doubt = [&](tester::TestKind test, double slope_pa, double strain) {
    return units.about(specimen_of(test, straight(slope_pa, strain))).value_or("");
  };
  for (const double ratio : {0.2, 1.0, 5.0}) EXPECT_EQ(doubt(tester::TestKind::modulus, ratio * modulus_pa, 0.01), "");
  EXPECT_THAT(doubt(tester::TestKind::modulus, 0.01 * modulus_pa, 1.0), HasSubstr("strain as a ratio")) << "per cent";
  EXPECT_THAT(doubt(tester::TestKind::modulus, 1e-3 * modulus_pa, 0.01), HasSubstr("is a unit wrong")) << "kPa";
  EXPECT_EQ(doubt(tester::TestKind::toughness, 0.1 * modulus_pa, 0.01), "") << "a deep notch";
  EXPECT_THAT(doubt(tester::TestKind::toughness, 0.004 * modulus_pa, 1.0), HasSubstr("begins with a slope of"));
  measurement::SpecimenRecord given = specimen_of(tester::TestKind::modulus, {});
  given.modulus_pa = 2.6e6;
  EXPECT_THAT(units.about(given).value_or(""), HasSubstr("its modulus is 0.0026 GPa"));
  given.valid = false;
  EXPECT_FALSE(units.about(given)) << "it does not count";
}

TEST(Plausibility, ReplicatesAreSimulatedOnce) {
  UnitDoubts units(material::thesis_parameters(), tester::Fidelity::tiny);
  measurement::SpecimenRecord specimen = specimen_of(tester::TestKind::modulus, {});
  specimen.modulus_pa = 1e3;
  for (int replicate = 0; replicate < 3; ++replicate) EXPECT_TRUE(units.about(specimen));
  EXPECT_TRUE(units.about(specimen_of(tester::TestKind::toughness, straight(1e3, 1.0)))) << "of the same design";
  EXPECT_EQ(units.simulations(), 1);
  specimen.design = *pattern::design_from_name("soft");
  EXPECT_TRUE(units.about(specimen));
  EXPECT_EQ(units.simulations(), 2);
}

}  // namespace
}  // namespace nacre::game
