#include <gtest/gtest.h>

#include "diagnosis/test_choice.hpp"

namespace nacre::diagnosis {
namespace {

TestValue test_that(AddedTest way, const std::vector<double>& errors) {
  TestValue value{{way}, {}};
  for (const double e : errors) value.pairs.push_back({e, Feature::log_modulus});
  return value;
}

std::vector<std::size_t> tests_of(const std::vector<TestChoice>& choices) {
  std::vector<std::size_t> tests;
  for (const TestChoice& choice : choices) tests.push_back(choice.test);
  return tests;
}

TEST(TestChoice, AnotherWayIsWorthMoreThanTheSameWayAgain) {
  const std::vector<TestValue> tests = {test_that(AddedTest::coupon, {9.0}), test_that(AddedTest::coupon, {8.0}),
                                        test_that(AddedTest::coupon, {7.0}), test_that(AddedTest::turned_twin, {3.0})};
  EXPECT_EQ(tests_of(choose_tests(tests, 3, {})), (std::vector<std::size_t>{0, 3, 1}));
}

TEST(TestChoice, APairThatIsStillOpenComesBeforeOneThatIsSettled) {
  const std::vector<TestValue> tests = {test_that(AddedTest::coupon, {9.0, 0.1}),
                                        test_that(AddedTest::turned_twin, {9.0, 0.2}),
                                        test_that(AddedTest::checkerboard, {0.0, 2.5})};
  const std::vector<TestChoice> chosen = choose_tests(tests, 2, {});
  EXPECT_EQ(tests_of(chosen), (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(chosen[0].pair, 0u);
  EXPECT_EQ(chosen[1].pair, 1u);
}

TEST(TestChoice, WhatServesTwoPairsComesBeforeWhatServesOneBetter) {
  const std::vector<TestValue> tests = {test_that(AddedTest::coupon, {4.0, 0.0}),
                                        test_that(AddedTest::turned_twin, {3.0, 3.0})};
  EXPECT_EQ(tests_of(choose_tests(tests, 1, {})), (std::vector<std::size_t>{1}));
}

TEST(TestChoice, NothingIsChosenThatSeparatesNoPairByItsNoise) {
  EXPECT_TRUE(
      choose_tests({test_that(AddedTest::coupon, {0.9}), test_that(AddedTest::turned_twin, {0.3})}, 4, {}).empty());
  EXPECT_EQ(tests_of(choose_tests(
                {test_that(AddedTest::coupon, {0.9, 1.1}), test_that(AddedTest::turned_twin, {0.3, 0.2})}, 4, {})),
            (std::vector<std::size_t>{0}));
  EXPECT_TRUE(choose_tests({}, 4, {}).empty());
}

TEST(TestChoice, TestsOfOneWayFollowEachOtherByWhatTheySeparate) {
  const std::vector<TestValue> tests = {test_that(AddedTest::coupon, {5.0}), test_that(AddedTest::coupon, {7.0}),
                                        test_that(AddedTest::coupon, {6.0})};
  EXPECT_EQ(tests_of(choose_tests(tests, 3, {})), (std::vector<std::size_t>{1, 2, 0}));
}

}  // namespace
}  // namespace nacre::diagnosis
