#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "material/effect_library.hpp"
#include "material/extensions.hpp"
#include "measurement/observe.hpp"
#include "measurement/summary.hpp"

namespace nacre::measurement {
namespace {

SpecimenRecord toughness_specimen(std::string name, double toughness_pa) {
  SpecimenRecord record;
  record.specimen = std::move(name);
  record.design = pattern::Mixture{1.0};
  record.test = tester::TestKind::toughness;
  record.toughness_pa = toughness_pa;
  record.curve = {{0.0, 0.1, 0.2, 0.3, 0.4}, {0.0, toughness_pa, 0.0, 0.0, 0.0}};
  return record;
}

SpecimenRecord modulus_specimen(std::string name, double modulus_pa) {
  SpecimenRecord record;
  record.specimen = std::move(name);
  record.design = pattern::Mixture{1.0};
  record.test = tester::TestKind::modulus;
  record.modulus_pa = modulus_pa;
  return record;
}

TEST(Summary, MeanDeviationAndRepresentativeCurveOfValidSpecimens) {
  std::vector<SpecimenRecord> specimens = {toughness_specimen("c", 5.0), toughness_specimen("a", 1.0),
                                           toughness_specimen("b", 2.4), modulus_specimen("m", 7.0)};
  specimens.push_back(toughness_specimen("bad", 100.0));
  specimens.back().valid = false;
  const std::vector<Replicates> groups = summarise(specimens);
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_EQ(groups[0].specimens, (std::vector<std::string>{"a", "b", "c", "m"}));
  EXPECT_EQ(groups[0].toughness_count, 3);
  EXPECT_DOUBLE_EQ(groups[0].toughness_pa, 2.8);
  EXPECT_NEAR(groups[0].toughness_sd_pa, std::sqrt((1.8 * 1.8 + 0.4 * 0.4 + 2.2 * 2.2) / 2.0), 1e-12);
  EXPECT_EQ(groups[0].modulus_count, 1);
  EXPECT_EQ(groups[0].modulus_pa, 7.0);
  EXPECT_EQ(groups[0].modulus_sd_pa, 0.0);
  EXPECT_EQ(groups[0].representative_curve.stress_pa[1], 2.4);
}

TEST(Summary, OrderOfArrivalAndRepeatsDoNotMatter) {
  std::vector<SpecimenRecord> specimens = {toughness_specimen("c", 0.1), toughness_specimen("a", 0.2),
                                           toughness_specimen("b", 0.3), toughness_specimen("d", 0.7)};
  specimens[0].batch = "P2";
  specimens[1].batch = "P1";
  specimens[2].conditions.orientation_deg = 90.0;
  const auto reference = summarise(specimens);
  ASSERT_EQ(reference.size(), 2u);
  EXPECT_EQ(reference[0].batch_list, "P1,P2");
  specimens.push_back(specimens[1]);
  std::sort(specimens.begin(), specimens.end(), [](const auto& a, const auto& b) { return a.specimen > b.specimen; });
  const auto shuffled = summarise(specimens);
  ASSERT_EQ(shuffled.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(shuffled[i].toughness_pa, reference[i].toughness_pa);
    EXPECT_EQ(shuffled[i].toughness_count, reference[i].toughness_count);
    EXPECT_EQ(shuffled[i].specimens, reference[i].specimens);
    EXPECT_EQ(shuffled[i].conditions, reference[i].conditions);
  }
}

TEST(Summary, CouponsAreLeftOut) {
  SpecimenRecord coupon = toughness_specimen("t", 1.0);
  coupon.test = tester::TestKind::tensile;
  EXPECT_TRUE(summarise({coupon}).empty());
}

TEST(Values, ToughnessIsGivenOrTheAreaUnderTheCurve) {
  SpecimenRecord record = toughness_specimen("a", 3.0);
  EXPECT_EQ(toughness_of(record), 3.0);
  record.toughness_pa.reset();
  EXPECT_NEAR(toughness_of(record).value(), 0.3, 1e-12);
  record.curve = {};
  EXPECT_FALSE(toughness_of(record));
}

TEST(Values, ModulusIsGivenOrTheInitialSlope) {
  SpecimenRecord record = modulus_specimen("a", 5.0);
  EXPECT_EQ(modulus_of(record), 5.0);
  record.modulus_pa.reset();
  EXPECT_FALSE(modulus_of(record));
  for (int k = 0; k < 40; ++k) {  // toe before, yielding after the interval that counts
    const double strain = 1e-4 * k;
    record.curve.strain.push_back(strain);
    record.curve.stress_pa.push_back(strain < 4.5e-4 ? 0.0 : strain > 2.55e-3 ? 2e6 : 1e9 * (strain - 3e-4));
  }
  EXPECT_NEAR(modulus_of(record).value(), 1e9, 1.0);
}

TEST(Values, WhatComesBackIntoTheIntervalSaysNothingOfTheModulus) {
  SpecimenRecord record = modulus_specimen("a", 5.0);
  record.modulus_pa.reset();
  const auto add = [&](double strain, double stress_pa) {
    record.curve.strain.push_back(strain);
    record.curve.stress_pa.push_back(stress_pa);
  };
  const auto load_to = [&](double strain) {
    record.curve = {};
    for (double at = 0.0; at <= strain; at += 1e-4) add(at, 2e9 * at);
  };
  load_to(0.01);
  for (double at = 0.01; at > 1e-3; at -= 1e-4) add(at, 2e9 * (at - 1e-3));
  EXPECT_NEAR(modulus_of(record).value(), 2e9, 10.0) << "unloaded with a set of 0.1 %";
  for (const double broken_at : {0.01, 0.0021}) {
    load_to(broken_at);
    for (int k = 0; k < 40; ++k) add(8e-4, 0.0);
    EXPECT_NEAR(modulus_of(record).value(), 2e9, 10.0) << "broken at " << broken_at;
  }
}

TEST(Values, ACoarseCurveIsReadByItsFirstChords) {
  SpecimenRecord record = modulus_specimen("a", 5.0);
  record.modulus_pa.reset();
  record.curve = {{0.0, 0.01, 0.02, 0.03, 0.04}, {0.0, 1e7, 1.5e7, 1.7e7, 1.8e7}};
  EXPECT_NEAR(modulus_of(record).value(), 1e9, 1.0);
  record.curve = {{0.0, 0.0015, 0.01, 0.02, 0.03}, {0.0, 1.5e6, 5.75e6, 6e6, 6e6}};  // 1 GPa, then 0.5 GPa
  EXPECT_NEAR(modulus_of(record).value(), 0.75e9, 1.0);
  record.curve.strain = {0.0, 0.06, 0.07, 0.08, 0.09};
  EXPECT_FALSE(modulus_of(record)) << "a chord to 6 %";
  record.curve.strain = {0.0006, 0.01, 0.02, 0.03, 0.04};
  EXPECT_FALSE(modulus_of(record)) << "begins too late";
  record.curve.strain = {0.0, 0.001, 0.0005, 0.02, 0.03};
  EXPECT_FALSE(modulus_of(record)) << "unloaded before the end of the interval";
  record.curve = {{0.0, 0.01, 0.02, 0.03, 0.04}, {0.0, -1e7, 0.0, 0.0, 0.0}};
  EXPECT_FALSE(modulus_of(record));
}

TEST(Observe, NothingChangesWithoutExtensions) {
  const tester::Curve curve = {{0.0, 0.1, 0.2}, {0.0, 1e6, 3.3e6}};
  for (const material::Extensions& none :
       {material::Extensions{}, material::Extensions{{"machine_compliance", {0.0}}}}) {
    EXPECT_EQ(observe_modulus(1.234567e9, none), 1.234567e9);
    EXPECT_EQ(observe_curve(curve, none), curve);
  }
}

TEST(Observe, MachineComplianceIsASpringInSeries) {
  const double compliance = 2e-10, modulus = 1.5e9;
  const material::Extensions machine = {{"machine_compliance", {compliance}}};
  EXPECT_NEAR(1.0 / observe_modulus(modulus, machine), 1.0 / modulus + compliance, 1e-22);
  const tester::Curve elastic = {{0.0, 0.001, 0.002}, {0.0, 0.001 * modulus, 0.002 * modulus}};
  const tester::Curve shown = observe_curve(elastic, machine);
  EXPECT_EQ(shown.stress_pa, elastic.stress_pa);
  EXPECT_NEAR(shown.stress_pa[2] / shown.strain[2], observe_modulus(modulus, machine), 1e-3);
  // A closed loop of stress gives back what the spring took: toughness to separation is not changed.
  const tester::Curve broken = {{0.0, 0.01, 0.011, 0.012}, {0.0, 1e7, 4e6, 0.0}};
  EXPECT_NEAR(tester::area_under(observe_curve(broken, machine)), tester::area_under(broken), 1e-6);
}

TEST(Observe, SlackComesBeforeTheCurveAndLeavesModulusAndArea) {
  const material::Extensions slack = {{"toe_slack", {0.004}}};
  const tester::Curve curve{.strain = {0.0, 0.01, 0.02}, .stress_pa = {0.0, 2e6, 1e6}};
  const tester::Curve shown = observe_curve(curve, slack);
  EXPECT_EQ(shown.strain, (std::vector<double>{0.0, 0.004, 0.014, 0.024}));
  EXPECT_EQ(shown.stress_pa, (std::vector<double>{0.0, 0.0, 2e6, 1e6}));
  EXPECT_NEAR(tester::area_under(shown), tester::area_under(curve), 1e-9);
  EXPECT_EQ(observe_modulus(1e9, slack), 1e9);
}

TEST(Observe, GainScalesForcesAfterTheMachineHasStretched) {
  const material::Extensions both = {{"load_cell_gain", {0.1}}, {"machine_compliance", {1e-10}}};
  EXPECT_NEAR(observe_modulus(1e9, both), 1.1 / (1e-9 + 1e-10), 1.0);
  const tester::Curve curve{.strain = {0.0, 0.01}, .stress_pa = {0.0, 1e7}};
  const tester::Curve shown = observe_curve(curve, both);
  EXPECT_NEAR(shown.stress_pa[1], 1.1e7, 1e-6);
  EXPECT_NEAR(shown.strain[1], 0.011, 1e-15);
}

TEST(Observe, DriftGoesWithTheBatchAndLeavesTheFirstOne) {
  const material::Extensions drift = {{"batch_drift", {-0.1}}};
  EXPECT_EQ(observe_modulus(1e9, drift), 1e9);
  EXPECT_NEAR(observe_modulus(1e9, drift, {.batch_step = 2.0}), 0.81e9, 1e-3);
  const tester::Curve curve{.strain = {0.0, 0.01}, .stress_pa = {0.0, 1e7}};
  EXPECT_NEAR(observe_curve(curve, drift, {.batch_step = 1.0}).stress_pa[1], 0.9e7, 1e-6);
}

TEST(Observe, TheWayBackThroughTheMachineIsExact) {
  const material::Extensions machine = {{"machine_compliance", {3e-10}}, {"load_cell_gain", {0.04}}};
  for (const double modulus_pa : {1e6, 5e8, 2.6e9})
    EXPECT_NEAR(modulus_behind(observe_modulus(modulus_pa, machine), machine) / modulus_pa, 1.0, 1e-12);
  EXPECT_TRUE(std::isinf(modulus_behind(5e9, machine))) << "the machine alone gives more";
}

TEST(Observe, ToughnessChangesAsTheAreaOfAPullToSeparationDoes) {
  const material::Extensions machine = {
      {"machine_compliance", {3e-10}}, {"toe_slack", {0.002}}, {"load_cell_gain", {0.04}}};
  const tester::Curve curve = {{0.0, 0.01, 0.02, 0.03, 0.04}, {0.0, 2e7, 3e7, 1e7, 0.0}};
  EXPECT_NEAR(observe_toughness(tester::area_under(curve), machine) / tester::area_under(observe_curve(curve, machine)),
              1.0, 1e-12);
}

TEST(Summary, SaysHowManyBatchesAfterTheFirstItsSpecimensWerePrinted) {
  std::vector<SpecimenRecord> specimens = {modulus_specimen("a", 1e9), modulus_specimen("b", 1e9),
                                           toughness_specimen("c", 1e5)};
  specimens[0].batch = "batch-1", specimens[1].batch = "batch-2", specimens[2].batch = "batch-10";
  const std::vector<Replicates> groups = summarise(specimens);
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_DOUBLE_EQ(groups[0].modulus_batch_step, 0.5);
  EXPECT_DOUBLE_EQ(groups[0].toughness_batch_step, 2.0);
}

TEST(PrintContexts, CountBatchesInTheirNaturalOrder) {
  std::vector<SpecimenRecord> specimens(5);
  const char* const batches[] = {"batch-10", "batch-2", "", "batch-2", "batch-1"};
  for (std::size_t i = 0; i < specimens.size(); ++i) specimens[i].batch = batches[i];
  std::vector<double> steps;
  for (const PrintContext& context : print_contexts(specimens)) steps.push_back(context.batch_step);
  EXPECT_EQ(steps, (std::vector<double>{2.0, 1.0, 0.0, 1.0, 0.0}));
}

TEST(PrintContexts, DoNotDependOnTheOrderOfRows) {
  std::vector<std::string> batches = {"batch-01", "batch-1", "batch-2"};
  std::vector<double> steps_of_last;
  do {
    std::vector<SpecimenRecord> specimens(7);
    for (std::size_t i = 0; i < specimens.size(); ++i) specimens[i].batch = batches[i % 3];
    const std::vector<PrintContext> contexts = print_contexts(specimens);
    for (std::size_t i = 0; i < 3; ++i)
      if (batches[i] == "batch-2") steps_of_last.push_back(contexts[i].batch_step);
  } while (std::ranges::next_permutation(batches).found);
  EXPECT_EQ(steps_of_last, std::vector<double>(6, 2.0));
}

TEST(Observe, EveryMeasurementEffectAtZeroShowsTheTruthToTheBit) {
  const tester::Curve curve{.strain = {0.0, 0.013, 0.027}, .stress_pa = {0.0, 2.3e6, 1.1e6}};
  for (const material::Effect& effect : material::effect_library()) {
    if (effect.side != material::EffectSide::measurement) continue;
    const material::Extensions zero = {{std::string(effect.name), {0.0}}};
    EXPECT_EQ(observe_modulus(1.234567e9, zero, {.batch_step = 3.0}), 1.234567e9) << effect.name;
    EXPECT_EQ(observe_curve(curve, zero, {.batch_step = 3.0}), curve) << effect.name;
  }
}

}  // namespace
}  // namespace nacre::measurement
