#pragma once

#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/verdict.hpp"

namespace nacre::diagnosis {

/// What a test adds to those that are there.
enum class AddedTest { twin, checkerboard, laminate, homogeneous };

/// A specimen that could be made and tested, with what a person calls it.
struct PossibleTest {
  AddedTest kind = AddedTest::twin;
  pattern::Design design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::TestConditions conditions;
  std::string words;  ///< "a twin printed turned by 90 degrees", ...
};

/// Whether a measured group is that test already: homogeneous coupons are to be unloaded.
bool answers(const PossibleTest& test, const Observation& group);

/// Tests that a laboratory could add to these: turned twins of measured designs, a tenfold rate and half the thickness
/// for the three most measured ones of each test, laminates and checkerboards of period 1, 2 and 5 both ways,
/// homogeneous coupons pulled and unloaded at two rates. What is measured already is left out.
std::vector<PossibleTest> possible_tests(const Observations& observations);

/// Strains on the way of a coupon that is pulled to 2 %, back to 0.5 % and on to 2.2 %.
std::vector<double> unload_history();

/// At most `count` tests that together would best tell the given models apart (choose_tests), by the differences of
/// their predicted features over the noise of `replicates` specimens. Fewer than two models: nothing to separate.
/// Fracture tests are simulated, one per model and test.
std::vector<NextExperiment> next_experiments(const std::vector<Fit>& models, const FeatureModel& model,
                                             const Observations& observations, tester::Fidelity fidelity, int count,
                                             int replicates = 3);

}  // namespace nacre::diagnosis
