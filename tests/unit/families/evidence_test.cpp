#include "families/evidence.hpp"

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "base/result.hpp"

namespace nacre::families {
namespace {

/// `confounder` drives both `rider` and the outcome; `driver` the outcome alone; `bystander` nothing.
struct FamilySample {
  FeatureColumn confounder{"confounder", {}}, rider{"rider", {}}, driver{"driver", {}}, bystander{"bystander", {}},
      outcome{"T", {}};
  explicit FamilySample(int rows, std::uint64_t seed = 1) {
    RandomStream random(seed, "evidence test");
    for (int i = 0; i < rows; ++i) {
      const double c = random.normal(), d = random.normal();
      confounder.values.push_back(c);
      driver.values.push_back(d);
      rider.values.push_back(c + 0.3 * random.normal());
      bystander.values.push_back(random.normal());
      outcome.values.push_back(2.0 * c + d + 0.5 * random.normal());
    }
  }
};

TEST(Associations, ControlsTakeOutWhatFeatureAndOutcomeOweToThem) {
  const FamilySample family(150);
  const auto found =
      associations({family.rider, family.driver, family.bystander}, family.outcome, {family.confounder}, 1);
  EXPECT_EQ(found[0].feature, "driver");
  EXPECT_GT(found[0].partial, 0.7);
  EXPECT_LT(found[0].p_family_wise, 0.01);
  for (const Association& each : found) {
    EXPECT_TRUE(each.feature != "rider" || each.spearman > 0.7);
    EXPECT_TRUE(each.feature == "driver" || each.p_family_wise > 0.01) << each.feature;
  }
}

TEST(Associations, OfNothingAreRarelyClaimed) {
  int claimed = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const FamilySample family(40, seed);
    RandomStream random(seed, "outcome");
    FeatureColumn noise{"noise", {}};
    for (int i = 0; i < 40; ++i) noise.values.push_back(random.normal());
    claimed += associations({family.rider, family.driver, family.bystander}, noise, {family.confounder}, seed, 200)[0]
                   .p_family_wise < 0.05;
  }
  EXPECT_LE(claimed, 8);  // 3 expected; 9 or more with a chance of 0.003
}

TEST(Associations, RefuseTooFewRows) {
  const FamilySample family(5);
  EXPECT_THROW(associations({family.driver}, family.outcome, {family.confounder}, 1), InputError);
}

}  // namespace
}  // namespace nacre::families
