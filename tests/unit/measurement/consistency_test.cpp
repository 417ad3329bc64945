#include "measurement/consistency.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "measurement/conditions.hpp"
#include "measurement/history.hpp"
#include "measurement/summary.hpp"

namespace nacre::measurement {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// A curve that rises to `peak_pa` at half of `break_strain` and falls to nothing.
tester::Curve triangle(double peak_pa, double break_strain) {
  tester::Curve curve;
  for (int i = 0; i <= 100; ++i) {
    const double share = i / 100.0;
    curve.strain.push_back(share * break_strain);
    curve.stress_pa.push_back(peak_pa * (share < 0.5 ? 2 * share : 2 * (1 - share)));
  }
  return curve;
}

SpecimenRecord notched(const std::string& name, double peak_pa, double break_strain, const std::string& path = "") {
  SpecimenRecord record;
  record.specimen = name;
  record.design = *pattern::design_from_name("577fffe9fffdef");
  record.test = tester::TestKind::toughness;
  record.curve = triangle(peak_pa, break_strain);
  record.toughness_pa = tester::area_under(record.curve);
  if (!path.empty()) record.other_columns["path"] = path;
  return record;
}

std::vector<SpecimenRecord> scattered_group(RandomStream& random, double peak_scatter, double strain_scatter) {
  std::vector<SpecimenRecord> group;
  for (int i = 0; i < 4; ++i) {
    group.push_back(notched("S" + std::to_string(i), 20e6 * std::exp(peak_scatter * random.normal()),
                            0.03 * std::exp(strain_scatter * random.normal())));
  }
  return group;
}

std::vector<SpecimenRecord> agreeing() {
  return {notched("A1", 20e6, 0.030), notched("A2", 20.5e6, 0.031), notched("A3", 19.6e6, 0.029),
          notched("A4", 20.2e6, 0.030)};
}

TEST(Replicates, ValuesThatAUnitExplainsAreDoubted) {
  std::vector<SpecimenRecord> specimens = agreeing();
  EXPECT_THAT(doubts_of_units(specimens), IsEmpty());
  specimens.push_back(notched("percent", 20e6, 3.0));
  specimens.push_back(notched("tough", 40e6, 0.09));
  const auto doubts = doubts_of_units(specimens);
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_EQ(doubts[0].specimen, "percent");
  EXPECT_THAT(doubts[0].text, HasSubstr("specimen percent: its toughness is 96.7 times the median of the 6"));
  specimens.back().valid = specimens[4].valid = false;
  EXPECT_THAT(doubts_of_units(specimens), IsEmpty()) << "what does not count is not doubted";
  EXPECT_EQ(doubts_of_units({notched("A", 20e6, 0.03), notched("kPa", 20e3, 0.03)}).size(), 2U)
      << "of two, either may be wrong";
}

TEST(Replicates, FourThatAgreeAreComplete) {
  const auto groups = review_replicates(agreeing());
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0].state, GroupState::complete);
  EXPECT_THAT(groups[0].proposed, IsEmpty());
  EXPECT_EQ(groups[0].tested.size(), 4U);
  EXPECT_EQ(groups[0].wanted, 0);
  EXPECT_FALSE(groups[0].representative.empty());
}

TEST(Replicates, OneThatBreaksEarlyIsProposedWithItsReasonAndNotDropped) {
  std::vector<SpecimenRecord> specimens = agreeing();
  specimens[2] = notched("A3", 11e6, 0.012);
  const auto groups = review_replicates(specimens);
  ASSERT_EQ(groups[0].proposed.size(), 1U);
  const ProposedOutlier& outlier = groups[0].proposed[0];
  EXPECT_EQ(outlier.specimen, "A3");
  std::string reasons;
  for (const OutlierReason& reason : outlier.reasons) reasons += reason.kind + ": " + reason.text + "\n";
  EXPECT_THAT(reasons, HasSubstr("toughness: its toughness is 78 % below the others'"));
  EXPECT_THAT(reasons, HasSubstr("peak: its peak is 46 % below"));
  EXPECT_THAT(reasons, HasSubstr("curve: its curve differs"));
  EXPECT_EQ(groups[0].valid.size(), 4U) << "a person decides";
  EXPECT_GT(groups[0].scatter, 4 * groups[0].scatter_without);
  EXPECT_EQ(groups[0].state, GroupState::complete);
  EXPECT_NE(groups[0].representative, "A3");
}

TEST(Replicates, TheUncommonCourseOfACrackIsProposed) {
  std::vector<SpecimenRecord> specimens = agreeing();
  for (auto& each : specimens) each.other_columns["path"] = "straight";
  specimens[1].other_columns["path"] = "into the grip";
  const auto groups = review_replicates(specimens);
  ASSERT_EQ(groups[0].proposed.size(), 1U);
  EXPECT_EQ(groups[0].proposed[0].specimen, "A2");
  EXPECT_THAT(groups[0].proposed[0].reasons[0].text, HasSubstr("`into the grip`, that of 3 others `straight`"));
}

TEST(Replicates, OneCourseMayBeSpeltInManyWays) {
  std::vector<SpecimenRecord> specimens = agreeing();
  specimens[0].other_columns["path"] = specimens[1].other_columns["path"] = "along the notch";
  specimens[2].other_columns["path"] = "Along  the notch";
  specimens[3].other_columns["path"] = "along the notch.";
  EXPECT_THAT(review_replicates(specimens)[0].proposed, IsEmpty());
}

/// A straight test to `last_strain`.
SpecimenRecord pulled(const std::string& name, tester::TestKind test, double modulus_pa, double last_strain) {
  SpecimenRecord record;
  record.specimen = name;
  record.design = *pattern::design_from_name("rigid");
  record.test = test;
  for (int i = 0; i <= 50; ++i) {
    record.curve.strain.push_back(last_strain * i / 50);
    record.curve.stress_pa.push_back(modulus_pa * record.curve.strain.back());
  }
  if (test == tester::TestKind::modulus) record.modulus_pa = modulus_pa;
  return record;
}

TEST(Replicates, HowFarABarOrACouponIsPulledIsNotHeldAgainstIt) {
  for (const auto test : {tester::TestKind::modulus, tester::TestKind::tensile}) {
    std::vector<SpecimenRecord> specimens = {pulled("A1", test, 2e9, 0.0060), pulled("A2", test, 2.01e9, 0.0060),
                                             pulled("A3", test, 1.99e9, 0.0062), pulled("A4", test, 2e9, 0.0100)};
    EXPECT_THAT(review_replicates(specimens)[0].proposed, IsEmpty()) << tester::to_string(test);
    specimens[3] = pulled("A4", test, 1.0e9, 0.0120);  // the same peak, but softer
    const auto proposed = review_replicates(specimens)[0].proposed;
    ASSERT_EQ(proposed.size(), 1U) << tester::to_string(test);
    EXPECT_EQ(proposed[0].specimen, "A4");
    EXPECT_EQ(proposed[0].reasons.size(), test == tester::TestKind::modulus ? 1U : 2U) << "peak and curve of coupons";
  }
}

TEST(Replicates, AsManyAreProposedAsLeaveThree) {
  // Two against two: either behaviour may be the common one.
  const auto groups = review_replicates(
      {notched("A1", 20e6, 0.030), notched("A2", 20e6, 0.031), notched("A3", 5e6, 0.010), notched("A4", 5.2e6, 0.010)});
  EXPECT_LE(groups[0].proposed.size(), 1U);
  EXPECT_NE(groups[0].state, GroupState::complete) << to_string(groups[0].state);
  EXPECT_GE(groups[0].wanted, 1);
}

TEST(Replicates, TooFewAskForMore) {
  std::vector<SpecimenRecord> specimens = agreeing();
  specimens.pop_back();
  EXPECT_EQ(review_replicates(specimens)[0].state, GroupState::more_needed);
  EXPECT_EQ(review_replicates(specimens)[0].wanted, 1);
  specimens = agreeing();
  specimens[0].valid = specimens[1].valid = false;
  EXPECT_EQ(review_replicates(specimens)[0].wanted, 1);
  EXPECT_EQ(review_replicates(specimens)[0].tested.size(), 4U);
}

TEST(Replicates, TheOrderOfArrivalDoesNotMatter) {
  std::vector<SpecimenRecord> specimens = agreeing();
  specimens[0] = notched("A1", 9e6, 0.011);
  const auto forwards = review_replicates(specimens);
  std::reverse(specimens.begin(), specimens.end());
  const auto backwards = review_replicates(specimens);
  ASSERT_EQ(forwards[0].proposed.size(), backwards[0].proposed.size());
  EXPECT_EQ(forwards[0].proposed[0].specimen, backwards[0].proposed[0].specimen);
  EXPECT_EQ(forwards[0].mean_pa, backwards[0].mean_pa);
}

TEST(Replicates, SpecimensOfUsualScatterAreSeldomProposed) {
  RandomStream random(1, "false alarms");
  int alarms = 0;
  constexpr int kGroups = 400;
  for (int group = 0; group < kGroups; ++group)
    alarms += !review_replicates(scattered_group(random, 0.06, 0.10))[0].proposed.empty();
  EXPECT_LE(alarms, kGroups / 20);
}

TEST(Replicates, AHalvedFailureStrainIsNearlyAlwaysProposed) {
  RandomStream random(2, "detections");
  int found = 0;
  constexpr int kGroups = 200;
  for (int group = 0; group < kGroups; ++group) {
    auto specimens = scattered_group(random, 0.04, 0.06);
    specimens[3] = notched("S3", 11e6, 0.015);
    const auto proposed = review_replicates(specimens)[0].proposed;
    found += proposed.size() == 1 && proposed[0].specimen == "S3";
  }
  EXPECT_GE(found, kGroups * 95 / 100);
}

TEST(NominalConditions, CallipersAndClocksDoNotPartReplicates) {
  std::vector<SpecimenRecord> specimens = agreeing();
  specimens[0].conditions.thickness_mm = 3.17;
  specimens[1].conditions.thickness_mm = 3.31;
  specimens[2].conditions.strain_rate_per_s = 6.3e-4;
  EXPECT_EQ(review_replicates(specimens).size(), 1U);
  EXPECT_EQ(summarise(at_nominal_conditions(specimens)).size(), 1U);
  specimens[0].conditions.thickness_mm = 2.02;
  specimens[1].conditions.thickness_mm = 1.98;
  const auto groups = review_replicates(specimens);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].tested.size(), 2U);
  EXPECT_EQ(groups[1].tested.size(), 2U);
}

SpecimenRecord bar(const std::string& name, const std::string& design, double modulus_pa, const std::string& batch,
                   int order) {
  SpecimenRecord record;
  record.specimen = name;
  record.design = *pattern::design_from_name(design);
  record.modulus_pa = modulus_pa;
  record.batch = batch;
  record.print_order = order;
  return record;
}

TEST(History, ABatchThatIsStifferOnTheSameDesignsIsNotable) {
  RandomStream random(3, "batches");
  std::vector<SpecimenRecord> specimens;
  for (const char* design : {"mix:0.5", "mix:0.7", "mix:0.9"}) {
    for (int copy = 0; copy < 8; ++copy) {
      const bool late = copy >= 4;
      specimens.push_back(bar(std::string(design) + std::to_string(copy), design,
                              1e9 * (late ? 1.1 : 1.0) * std::exp(0.02 * random.normal()), late ? "b" : "a", 0));
    }
  }
  const auto effects = history_effects(specimens);
  ASSERT_EQ(effects.size(), 2U);
  for (const HistoryEffect& effect : effects) {
    EXPECT_TRUE(effect.notable()) << effect.level;
    EXPECT_NEAR(effect.relative, effect.level == "b" ? 0.05 : -0.05, 0.015);  // against the mean of both batches
  }
}

/// Share of sets without any effect in which one is notable: `designs` in two batches, `copies` of each in each.
double false_alarms(int designs, int copies) {
  RandomStream random(7, "nulls");
  int alarms = 0;
  constexpr int kSets = 1000;
  for (int set = 0; set < kSets; ++set) {
    std::vector<SpecimenRecord> specimens;
    for (int i = 0; i < 2 * designs * copies; ++i) {
      const std::string design = "mix:0." + std::to_string(50 + i % designs);
      specimens.push_back(bar("S" + std::to_string(i), design, 1e9 * std::exp(0.02 * random.normal()),
                              i < designs * copies ? "a" : "b", i + 1));
    }
    const auto effects = history_effects(specimens);
    alarms += std::any_of(effects.begin(), effects.end(), [](const auto& effect) { return effect.notable(); });
  }
  return static_cast<double>(alarms) / kSets;
}

// Three designs with one specimen in each of two batches leave two degrees of freedom, not four, and two degrees ask
// for more than three standard errors: 9 % of the first had something notable.
TEST(History, ChanceMakesFewBatchesNotable) {
  EXPECT_LE(false_alarms(3, 1), 0.06);
  EXPECT_LE(false_alarms(2, 2), 0.06);
  EXPECT_LE(false_alarms(6, 2), 0.06);
  EXPECT_GE(false_alarms(6, 2), 0.01) << "not stricter than that";
}

TEST(History, BatchesWithoutACommonDesignSayNothing) {
  std::vector<SpecimenRecord> specimens;
  for (int copy = 0; copy < 4; ++copy) {
    specimens.push_back(bar("A" + std::to_string(copy), "mix:0.5", 1e9 + 1e6 * copy, "a", 0));
    specimens.push_back(bar("B" + std::to_string(copy), "mix:0.9", 2e9 + 1e6 * copy, "b", 0));
  }
  EXPECT_THAT(history_effects(specimens), IsEmpty());
}

TEST(History, ADriftWithPrintOrderIsFound) {
  std::vector<SpecimenRecord> specimens;
  for (int order = 1; order <= 20; ++order) {
    const char* design = order % 2 == 0 ? "mix:0.5" : "mix:0.9";
    specimens.push_back(
        bar("S" + std::to_string(order), design, (order % 2 == 0 ? 1e9 : 2e9) * std::exp(0.01 * order), "a", order));
  }
  const auto effects = history_effects(specimens);
  ASSERT_EQ(effects.size(), 1U);
  EXPECT_EQ(effects[0].factor, "print_order");
  EXPECT_TRUE(effects[0].notable());
  EXPECT_NEAR(effects[0].relative, std::expm1(0.1), 0.005);
}

TEST(History, ADriftIsAsLargeWhereReplicatesArePrintedOneAfterAnother) {
  std::vector<SpecimenRecord> specimens;
  for (int order = 1; order <= 30; ++order) {
    const int design = (order - 1) / 3;
    specimens.push_back(bar("S" + std::to_string(order), "mix:0." + std::to_string(50 + design),
                            1e9 * (1.0 + design) * std::exp(0.01 * order + 1e-4 * (order % 2)), "a", order));
  }
  const auto effects = history_effects(specimens);
  ASSERT_EQ(effects.size(), 1U);
  EXPECT_NEAR(effects[0].relative, std::expm1(0.1), 0.005);
}

}  // namespace
}  // namespace nacre::measurement
