#pragma once
// Greedy choice of tests that separate pairs of models: chance of confusion Phi(-d / 2), d^2 summed over tests of
// different ways.

#include <cstddef>
#include <vector>

#include "diagnosis/possible_tests.hpp"

namespace nacre::diagnosis {

/// Difference of two models' predictions of a test, in standard errors of the feature that shows it most.
struct Separation {
  double errors = 0.0;
  Feature feature = Feature::log_modulus;
};

/// Separation of every pair of models by a possible test.
struct TestValue {
  TestWay way;                    ///< tests of one way share the errors of all models there
  std::vector<Separation> pairs;  ///< in the same order in every test
};

/// A test that is chosen, and the pair of models that it helps most.
struct TestChoice {
  std::size_t test = 0, pair = 0;
};

/// At most `count` tests, chosen one after another so that the chance of taking one model of a pair for the other falls
/// most, summed over the pairs. It is that of two normal distributions d standard deviations apart, Phi(-d/2); d^2 sums
/// the squared errors of the best test of each way, none counted as more than four standard errors: predictions of
/// tests are not better than that. Where no chance falls any more, the largest separation comes first. A test that
/// separates no pair by a standard error is never chosen, nor one for a pair that it separates by less.
std::vector<TestChoice> choose_tests(const std::vector<TestValue>& tests, int count, const TestRules& rules);

}  // namespace nacre::diagnosis
