#include "game/standings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "game/model.hpp"

namespace nacre::game {
namespace {

using measurement::SpecimenRecord;
using testing::ElementsAre;

SpecimenRecord modulus(const std::string& name, const pattern::Design& design, double modulus_pa) {
  SpecimenRecord record;
  record.specimen = name;
  record.design = design;
  record.modulus_pa = modulus_pa;
  return record;
}
SpecimenRecord toughness(const std::string& name, const pattern::Design& design, double toughness_pa) {
  SpecimenRecord record;
  record.specimen = name;
  record.design = design;
  record.test = tester::TestKind::toughness;
  record.toughness_pa = toughness_pa;
  return record;
}

/// The same specimen pulled ten times as fast: stiffer and tougher.
SpecimenRecord fast_twin(SpecimenRecord record) {
  record.specimen += "-fast";
  record.conditions.strain_rate_per_s *= 10.0;
  if (record.modulus_pa) *record.modulus_pa *= 2.0;
  if (record.toughness_pa) *record.toughness_pa *= 3.0;
  return record;
}

/// Pulled ten times as slowly: sorted before the others.
SpecimenRecord slow_twin(SpecimenRecord record) {
  record.specimen += "-slow";
  record.conditions.strain_rate_per_s *= 0.1;
  if (record.modulus_pa) *record.modulus_pa *= 0.5;
  if (record.toughness_pa) *record.toughness_pa *= 0.3;
  return record;
}

TEST(Standings, OnlyUprightValidPatternsCompete) {
  pattern::Layout coupon;
  coupon.set(0, 3, true);
  SpecimenRecord turned = modulus("turned", pattern::Pattern(7), 9e9);
  turned.conditions.orientation_deg = 90.0;
  SpecimenRecord invalid = modulus("invalid", pattern::Pattern(7), 9e9);
  invalid.valid = false;
  const std::vector<SpecimenRecord> specimens = {modulus("a", pattern::Pattern(7), 1e9),
                                                 toughness("b", pattern::Pattern(7), 2e5),
                                                 modulus("c", pattern::Pattern(7), 3e9),
                                                 modulus("d", coupon, 9e9),
                                                 toughness("e", coupon, 9e5),
                                                 modulus("f", pattern::Mixture{0.7}, 9e9),
                                                 turned,
                                                 invalid,
                                                 modulus("lonely", pattern::Pattern(9), 9e9)};
  EXPECT_THAT(measured_performances(measured_values(specimens)), ElementsAre(optimize::Performance{2e9, 2e5}));
}

TEST(Standings, WhereNotAllSpecimensCanBeNamedEveryTestKeepsReplicates) {
  std::vector<SpecimenRecord> specimens;
  for (const char* number : {"1", "2", "3"}) {
    specimens.push_back(modulus(std::string("a/") + number, pattern::Pattern(7), 1e9));
    specimens.push_back(toughness(std::string("b/") + number, pattern::Pattern(7), 1e5));
  }
  specimens[4].conditions.thickness_mm = 3.17;  // as callipers show 3.2
  SpecimenRecord invalid = modulus("0", pattern::Pattern(9), 1e9);
  invalid.valid = false;
  specimens.push_back(invalid);
  specimens.push_back(modulus("z", pattern::Pattern(9), 1e9));
  const std::size_t bytes = 6 * (3 + 9) + 1 + 9;
  EXPECT_THAT(specimens_to_name(specimens, bytes), ElementsAre("a/1", "a/2", "a/3", "b/1", "b/2", "b/3", "z"));
  EXPECT_THAT(specimens_to_name(specimens, bytes - 1), ElementsAre("a/1", "a/2", "a/3", "b/1", "b/2", "z"));
  EXPECT_THAT(specimens_to_name(specimens, bytes - 24), ElementsAre("a/1", "a/2", "b/1", "b/2", "z"));
}

TEST(Standings, HypervolumeErrorOfOneDesignIsThatOfAProductOfMeans) {
  // One design: hv = E T / 1e15, so relative variances of the two means add.
  std::map<pattern::Pattern, MeasuredValues> values;
  values[pattern::Pattern(7)] = {{0.9e9, 1.0e9, 1.1e9}, {2.0e5, 2.0e5, 2.0e5}};
  const double standard_error_of_mean = 0.1 / std::sqrt(3.0);
  EXPECT_NEAR(hypervolume_error(values, 1, 20000), 0.2 * standard_error_of_mean, 0.03 * 0.2 * standard_error_of_mean);
}

TEST(Standings, HypervolumeErrorIsZeroWithoutScatterAndTheSameForTheSameSeed) {
  std::map<pattern::Pattern, MeasuredValues> values;
  values[pattern::Pattern(7)] = {{1e9}, {2e5}};
  EXPECT_EQ(hypervolume_error(values, 1), 0.0);
  EXPECT_EQ(hypervolume_error({}, 1), 0.0);
  values[pattern::Pattern(7)].modulus_pa = {1e9, 2e9};
  EXPECT_EQ(hypervolume_error(values, 1), hypervolume_error(values, 1));
  EXPECT_NE(hypervolume_error(values, 1), hypervolume_error(values, 2));
}

TEST(Standings, BenchmarkRunsThroughTheMixturesByRigidFraction) {
  std::vector<SpecimenRecord> specimens = {
      modulus("a", pattern::Mixture{1.0}, 2.6e9), toughness("b", pattern::Mixture{1.0}, 7e4),
      modulus("c", pattern::Mixture{0.5}, 0.5e9), toughness("d", pattern::Mixture{0.5}, 8e5),
      modulus("e", pattern::Mixture{0.7},
              1.0e9),  // its toughness is still to come
      modulus("f", pattern::Pattern(7), 1.0e9),   toughness("g", pattern::Pattern(7), 1e5)};
  EXPECT_THAT(benchmark_line(specimens),
              ElementsAre(optimize::Performance{0.5e9, 8e5}, optimize::Performance{2.6e9, 7e4}));
}

TEST(Standings, BenchmarkIsMeasuredUnderStandardConditions) {
  const SpecimenRecord stiff = modulus("a", pattern::Mixture{0.7}, 1e9),
                       tough = toughness("b", pattern::Mixture{0.7}, 4e5);
  EXPECT_THAT(benchmark_line({stiff, tough, slow_twin(stiff), slow_twin(tough)}),
              ElementsAre(optimize::Performance{1e9, 4e5}));
  EXPECT_THAT(benchmark_line({slow_twin(stiff), slow_twin(tough)}), testing::IsEmpty());
  SpecimenRecord thin = stiff;
  thin.conditions.thickness_mm = 1.6;
  EXPECT_THAT(benchmark_line({thin, tough}), testing::IsEmpty());
}

TEST(Standings, ATwinPulledFasterIsCalibratedOnButIsNeitherPredictedNorASeedOfFamilies) {
  const pattern::Design design = pattern::Pattern(7);
  const SpecimenRecord stiff = modulus("a", design, 1e9), tough = toughness("b", design, 4e5);
  const std::vector<SpecimenRecord> specimens = {
      stiff, tough, fast_twin(stiff), fast_twin(tough), slow_twin(stiff), slow_twin(tough)};
  const auto set = calibration_set(specimens);
  EXPECT_EQ(set.size(), 3u) << "each predicted at its own rate";
  std::map<std::string, sysid::Prediction> predictions;
  predictions[design.name()].modulus_pa = 1.2e9;
  const PredictedDesigns predicted = predicted_among(set, predictions);
  ASSERT_EQ(predicted.measured.size(), 1u);
  EXPECT_EQ(predicted.predicted.size(), 1u);
  EXPECT_EQ(predicted.measured.front().modulus_pa, 1e9);
  const auto seeds = patterns_with_both(specimens);
  ASSERT_EQ(seeds.size(), 1u);
  EXPECT_EQ(seeds.front().toughness_pa, 4e5);
}

TEST(Standings, CalibrationSetHoldsLayoutsNotMixturesNorTwins) {
  SpecimenRecord turned = modulus("turned", pattern::Pattern(7), 9e9);
  turned.conditions.orientation_deg = 90.0;
  pattern::Layout coupon;
  coupon.set(0, 3, true);
  const auto set = calibration_set({modulus("a", pattern::Pattern(7), 1e9), modulus("b", pattern::Mixture{0.7}, 1e9),
                                    turned, modulus("c", coupon, 2e9)});
  ASSERT_EQ(set.size(), 2u);
  for (const auto& each : set) EXPECT_EQ(each.modulus_count, 1);
}

TEST(Standings, CalliperReadingsDoNotTearReplicatesApart) {
  std::vector<SpecimenRecord> specimens = {modulus("a", pattern::Pattern(7), 1e9),
                                           modulus("b", pattern::Pattern(7), 2e9)};
  specimens[0].conditions.thickness_mm = 3.17;
  specimens[1].conditions.thickness_mm = 3.24;
  const auto set = calibration_set(specimens);
  ASSERT_EQ(set.size(), 1u);
  EXPECT_EQ(set.front().modulus_count, 2);
}

TEST(Standings, PredictedDesignsAreMeasuredOnesWithTheirPredictions) {
  const pattern::Design predicted_design = pattern::Pattern(7);
  const auto set = calibration_set({modulus("a", predicted_design, 1e9), modulus("b", pattern::Pattern(9), 1e9)});
  std::map<std::string, sysid::Prediction> predictions;
  predictions[predicted_design.name()].modulus_pa = 1.2e9;
  predictions["never measured"].modulus_pa = 5e9;
  const PredictedDesigns predicted = predicted_among(set, predictions);
  ASSERT_EQ(predicted.measured.size(), 1u);
  ASSERT_EQ(predicted.predicted.size(), 1u);
  EXPECT_EQ(predicted.measured.front().design, predicted_design);
  EXPECT_EQ(predicted.predicted.front().modulus_pa, 1.2e9);
}

// With an adopted machine the gamut, which knows the material side alone, would lie far above what can be measured.
TEST(Machine, GamutAndMeasurementsMeetInWhatItShows) {
  material::ParameterSet model = material::thesis_parameters();
  const optimize::Performance simulated{1.9e9, 3e5};
  EXPECT_EQ(through_machine(simulated, model).modulus_pa, simulated.modulus_pa);
  model.extensions = {{"machine_compliance", {3e-10}}, {"load_cell_gain", {0.02}}, {"droplet_mixing", {1.0}}};
  const optimize::Performance shown = through_machine(simulated, model);
  EXPECT_NEAR(shown.modulus_pa, 1.02 * 1.9e9 / (1.0 + 3e-10 * 1.9e9), 1.0);
  EXPECT_NEAR(shown.toughness_pa, 1.02 * 3e5, 1e-6);
  const optimize::Performance back = behind_machine(shown, model);
  EXPECT_NEAR(back.modulus_pa / simulated.modulus_pa, 1.0, 1e-12);
  EXPECT_NEAR(back.toughness_pa / simulated.toughness_pa, 1.0, 1e-12);
}

}  // namespace
}  // namespace nacre::game
