// Batches of fracture tests against the same tests on the processor: the steps of a device, emulated; and a real device
// where there is one.

#include "gpu/batch_tester.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "../../instrumented.hpp"
#include "gpu/cuda.hpp"
#include "gpu/emulated_device.hpp"

namespace nacre::gpu {
namespace {

tester::FractureTest fracture_of(const std::string& key, const material::Extensions& extensions = {},
                                 double strain_limit = 0.0) {
  tester::Simulation simulation{.design = pattern::design_from_name(key).value(),
                                .parameters = material::thesis_parameters(),
                                .conditions = {},
                                .fidelity = tester::Fidelity::tiny};
  simulation.parameters.extensions = extensions;
  tester::FractureTest test = tester::fracture_test(simulation);
  if (strain_limit > 0.0) test.strain_limit = strain_limit;
  return test;
}

constexpr const char* kPattern = "577fffe9fffdef";
constexpr const char* kOther = "3ffdbefbf7efef";

/// All tests through a batch of `places`, results in the order of the tests.
std::vector<Result<tester::ToughnessResult>> pulled(std::unique_ptr<Device> device, int places,
                                                    const std::vector<tester::FractureTest>& tests) {
  BatchTester batch(std::move(device), places);
  for (std::size_t i = 0; i < tests.size(); ++i) {
    auto prepared = PreparedTest::of(tests[i]);
    EXPECT_TRUE(prepared);
    batch.add({static_cast<int>(i), *std::move(prepared)});
  }
  std::map<int, Result<tester::ToughnessResult>> results;
  while (batch.pending() > 0)
    for (NumberedResult& over : batch.turn()) results.emplace(over.number, std::move(over.result));
  std::vector<Result<tester::ToughnessResult>> in_order;
  for (auto& [number, result] : results) in_order.push_back(std::move(result));
  return in_order;
}

void expect_agreement(const tester::ToughnessResult& batch, const tester::ToughnessResult& alone) {
  ASSERT_FALSE(alone.breaks.empty());
  ASSERT_FALSE(batch.breaks.empty());
  const double first = alone.breaks.front().strain;
  EXPECT_LT(tester::largest_difference(alone.curve, batch.curve, first), 1e-3);
  EXPECT_NEAR(batch.breaks.front().strain / first, 1.0, 1e-3);
  EXPECT_EQ(batch.breaks.front().element, alone.breaks.front().element);
  // After the first failures rounding decides between nearly equal paths.
  EXPECT_NEAR(std::log(batch.toughness_pa / alone.toughness_pa), 0.0, 0.3);
  EXPECT_EQ(batch.end, alone.end);
}

TEST(BatchTester, GivesWhatTheProcessorsKernelGives) {
  const auto alone = tester::run_fracture_test<float>(fracture_of(kPattern));
  const auto batch = pulled(emulated_device(1), 1, {fracture_of(kPattern)});
  ASSERT_TRUE(alone);
  ASSERT_EQ(batch.size(), 1u);
  ASSERT_TRUE(batch.front());
  expect_agreement(*batch.front(), *alone);
}

// Only as far as a small strain: no element fails, so that the curves have to agree to rounding.
TEST(BatchTester, FollowsEveryPartOfTheExtendedLaw) {
  const material::Extensions parts[] = {{{"rigid_yield", {2e7}}},          {{"soft_stiffening", {2.0}}},
                                        {{"rate_dependence", {0.6, 5.0}}}, {{"progressive_damage", {0.5}}},
                                        {{"tension_only_failure", {1.0}}}, {{"residual_strain", {0.002}}}};
  for (const material::Extensions& extensions : parts) {
    SCOPED_TRACE(extensions.begin()->first);
    const tester::FractureTest test = fracture_of(kPattern, extensions, 0.004),
                               plain = fracture_of(kPattern, {}, 0.004);
    const auto alone = tester::run_fracture_test<float>(test), base = tester::run_fracture_test<float>(plain);
    const auto batch = pulled(emulated_device(1), 1, {test});
    ASSERT_TRUE(alone && base && batch.front());
    EXPECT_LT(tester::largest_difference(alone->curve, batch.front()->curve, 1.0), 1e-3);
    EXPECT_NEAR(batch.front()->toughness_pa / alone->toughness_pa, 1.0, 1e-3);
  }
}

TEST(BatchTester, WhatASpecimenDoesHingesOnNoOther) {
  std::vector<tester::FractureTest> tests = {fracture_of(kPattern, {}, 0.004),
                                             fracture_of(kOther, {{"rigid_yield", {2e7}}}, 0.002),
                                             fracture_of("rigid", {}, 0.006), fracture_of(kOther, {}, 0.003),
                                             fracture_of(kPattern, {{"progressive_damage", {0.5}}}, 0.002)};
  const auto together = pulled(emulated_device(2), 2, tests);
  ASSERT_EQ(together.size(), tests.size());
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const auto alone = pulled(emulated_device(1), 1, {tests[i]});
    ASSERT_TRUE(together[i] && alone.front());
    EXPECT_EQ(together[i]->curve.stress_pa, alone.front()->curve.stress_pa) << i;
    EXPECT_EQ(together[i]->steps, alone.front()->steps) << i;
  }
}

TEST(BatchTester, AnInstableSolutionIsAnErrorAndNoNumber) {
  tester::FractureTest test = fracture_of(kPattern);
  test.settings.largest_courant_number = 100.0;
  test.settings.gamma_per_s /= 20.0;
  test.settings.time_step_s *= 6.0;
  ASSERT_FALSE(tester::run_fracture_test<float>(test));
  const auto batch = pulled(emulated_device(1), 1, {test});
  ASSERT_FALSE(batch.front());
  EXPECT_NE(batch.front().error().message.find("blew up"), std::string::npos) << batch.front().error().message;
}

TEST(BatchTester, PlacesFollowFromMemory) {
  const auto prepared = PreparedTest::of(fracture_of(kPattern));
  const auto device = emulated_device(1);
  const int places = places_for(*device, prepared->image(), 100'000);
  EXPECT_GT(places, 100);
  EXPECT_LT(static_cast<double>(places) * static_cast<double>(prepared->image().device_numbers()) * sizeof(float),
            static_cast<double>(device->free_bytes()));
  EXPECT_EQ(places_for(*device, prepared->image(), 3), 3);
}

TEST(CudaDevice, GivesWhatTheProcessorsKernelGives) {
  auto device = cuda_device(3);
  if (!device) GTEST_SKIP() << device.error().message;
  const std::vector<tester::FractureTest> tests = {
      fracture_of(kPattern), fracture_of(kOther), fracture_of(kPattern, {{"rigid_yield", {2e7}}}), fracture_of("rigid"),
      fracture_of(kOther, {{"progressive_damage", {0.5}}})};
  const auto batch = pulled(*std::move(device), 3, tests);
  ASSERT_EQ(batch.size(), tests.size());
  for (std::size_t i = 0; i < tests.size(); ++i) {
    SCOPED_TRACE(i);
    const auto alone = tester::run_fracture_test<float>(tests[i]);
    ASSERT_TRUE(batch[i]) << batch[i].error().message;
    expect_agreement(*batch[i], *alone);
  }
}

}  // namespace
}  // namespace nacre::gpu
