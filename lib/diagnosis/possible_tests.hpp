#pragma once
// Tests that a laboratory could add to a measurement set.

#include <compare>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/observations.hpp"
#include "measurement/surroundings.hpp"
#include "tester/loading.hpp"

namespace nacre::diagnosis {

/// How a test differs from the measured ones: twins of measured designs, layouts of simple geometry, homogeneous
/// coupons.
enum class AddedTest {
  turned_twin,
  faster_twin,
  twin_between_rates,
  thinner_twin,
  checkerboard,
  laminate_across,  ///< the pull
  laminate_along,
  coupon,
  faster_coupon,
  coupon_between_rates,
  paused_coupon,
  notched,        ///< a homogeneous specimen
  at_other_rate,  ///< the modulus of a homogeneous specimen, as those that follow
  relaxation,     ///< after a hold
  at_other_temperature,
  in_other_humidity,
  at_other_age,
  on_other_machine,
  on_two_machines,  ///< each piece on both
};
bool is_twin(AddedTest kind);

/// Tests of one way share the errors of all models there.
struct TestWay {
  AddedTest kind = AddedTest::turned_twin;
  int period = 0;  ///< of a checkerboard or laminate, pixels
  auto operator<=>(const TestWay&) const = default;
};

/// A specimen that could be made and tested.
struct PossibleTest {
  TestWay way;
  pattern::Design design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::TestConditions conditions;
  double batch_step = 0.0;                  ///< of a batch to come; 0 where there is one batch
  std::map<std::string, int> batches = {};  ///< measured ones that its pieces are of, as in Observation
  measurement::Surroundings surroundings = {};
  tester::Loading pauses = {};             ///< of a coupon; none: it is unloaded on its way (coupon_loading())
  int machine = 0;                         ///< as in Observation
  std::optional<int> second_machine = {};  ///< the same pieces are tested on this one too
  double print_order = 0.0;                ///< as in Observation
  bool is_of_measured_batch = false;       ///< further pieces of the batch that the measured ones are of, or those
};

/// Whether it is a fracture test of a layout of simple geometry, whose modulus gives the same information for less.
bool is_told_by_modulus(const PossibleTest& test);

/// Whether replicates of the test would join the group (measurement::same_conditions): homogeneous coupons are to be
/// unloaded. Surroundings are equal within what no laboratory holds.
bool would_join(const PossibleTest& test, const Observation& group);

/// How long its strain is held, s; nothing where it is not.
std::optional<double> hold_of(const PossibleTest& test);

/// The group that replicates of it would be, before anything is measured.
Observation group_of(const PossibleTest& test, int replicates);

/// The surroundings of most groups, with the number of their machine.
struct UsualSurroundings {
  measurement::Surroundings surroundings;
  int machine = 0;
};
UsualSurroundings usual_surroundings(const Observations& observations);

/// Tests that a laboratory could add to these: turned twins of measured designs, other rates and half the thickness for
/// the three most measured ones of each test, laminates and checkerboards of period 1, 2 and 5 both ways, homogeneous
/// coupons pulled and unloaded as fast as is usual and at other rates: ten times that, and where measured rates lie a
/// hundredfold apart the middle of the gap; beside fracture tests homogeneous specimens with a notch; where no layout
/// is among the data, coupons with pauses and moduli of homogeneous specimens (specimen_moduli.hpp). Where there are
/// batches they are printed in a new one, unless they differ in one condition alone from measured ones. Tests that were
/// made already, at these conditions or within their tolerance, are left out.
std::vector<PossibleTest> possible_tests(const Observations& observations, const TestRules& rules);

/// A pull to 2 % strain, back to 0.5 % and on to 2.2 %: the loading of homogeneous coupons that are ordered.
tester::Loading coupon_loading();

/// Strains of that loading; and those up to the first pause of a programme that has some.
std::vector<double> unload_history();
std::vector<double> strains_of(const tester::Loading& pauses);

}  // namespace nacre::diagnosis
