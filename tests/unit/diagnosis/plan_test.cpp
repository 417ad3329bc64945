#include "diagnosis/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/candidates.hpp"
#include "diagnosis/workbench.hpp"
#include "material/extensions.hpp"
#include "synthetic_set.hpp"

namespace nacre::diagnosis {
namespace {

class Plans : public testing::Test {
 protected:
  Plans() {
    settings_.start = material::default_parameters();
    settings_.fidelity = tester::Fidelity::tiny;
  }
  PlannedEffect planned(const std::vector<measurement::SpecimenRecord>& specimens, std::string_view effect) const {
    const Plan plan = plan_diagnosis(specimens, settings_, kScatter, false);
    return *std::ranges::find(plan.effects, effect, &PlannedEffect::name);
  }
  material::ParameterSet with(const std::string& effect, double value) const {
    material::ParameterSet set = settings_.start;
    set.extensions[effect] = {value};
    return set;
  }
  double signal(const std::vector<measurement::SpecimenRecord>& plain,
                const std::vector<measurement::SpecimenRecord>& changed) const {
    return signal_of_change(plain, changed, settings_, kScatter);
  }

  static constexpr AssumedScatter kScatter{.modulus = 0.01, .stress = 0.01, .strain = 0.01};
  DiagnosisSettings settings_;
};

TEST_F(Plans, ACauseWithoutANameIsCountedLikeOneOfTheLibrary) {
  // The same change of the same specimens: as a signature of the library, and as what another set of values shows.
  const SyntheticSet set{.patterns = 10, .twins = 3, .noise = 0.0};
  const material::Effect& mixing = *material::find_effect("droplet_mixing");
  const double typical = material::value_at_strength(mixing.parameters.front(), kSizes[kTypicalSize]);
  const auto plain = synthetic_specimens(set, settings_.start),
             changed = synthetic_specimens(set, with("droplet_mixing", typical));
  const double s = signal(plain, changed);
  EXPECT_GT(s, 3.0);
  EXPECT_NEAR(s, planned(plain, "droplet_mixing").signal_to_noise, 1e-3 * s);
}

// Coupons of a soft rigid ink carry little stress: what it yields at is that of the ink, not of the thesis'.
TEST_F(Plans, CouponsAreThoseOfTheInksThatAreGiven) {
  settings_.start.modulus.e_vw_pa = 1.1e9;
  settings_.start.modulus.e_if_pa = 2.2e8;
  settings_.ranges.base_modulus[1] = {"e_vw_pa", 8e8, 1.5e9};
  settings_.ranges.base_modulus[2] = {"e_if_pa", 1.5e8, 3e8};
  const auto planned_yield = [&] {
    return planned(synthetic_coupons(settings_.start, {1e-3}, 3, 0.0, 1), "rigid_yield").smallest_seen.value();
  };
  const double own = planned_yield();
  settings_.start = material::default_parameters();
  settings_.ranges = material::thesis_ranges();
  EXPECT_LT(own, 0.6 * planned_yield());
}

// Flow leaves nothing until stress reaches the yield stress: the smallest effect is where it begins to show.
TEST_F(Plans, AYieldStressIsSeenFromWhereItShows) {
  const auto pulled = [&](const material::ParameterSet& truth) { return synthetic_coupons(truth, {1e-3}, 3, 0.0, 1); };
  const auto plain = pulled(settings_.start);
  const PlannedEffect flow = planned(plain, "rigid_yield");
  ASSERT_TRUE(flow.smallest_seen.has_value());
  EXPECT_GT(signal(plain, pulled(with("rigid_yield", *flow.smallest_seen))), kVisibleSignal);
  EXPECT_LT(signal(plain, pulled(with("rigid_yield", 1.4 * *flow.smallest_seen))), kVisibleSignal);
}

// A machine that gives way looks nearly like softer materials on specimens of all stiffnesses; what is left is seen.
TEST_F(Plans, WhatTheBaseMostlyImitatesIsSeenByWhatIsLeft) {
  const auto printed = [&](double compliance_per_pa) {
    const auto truth = compliance_per_pa > 0.0 ? with("machine_compliance", compliance_per_pa) : settings_.start;
    auto specimens = synthetic_specimens({.patterns = 14, .twins = 5, .noise = 0.0}, truth);
    const auto coupons = synthetic_coupons(truth, {1e-3}, 3, 0.0, 1);
    specimens.insert(specimens.end(), coupons.begin(), coupons.end());
    return specimens;
  };
  const auto plain = printed(0.0);
  const PlannedEffect compliance = planned(plain, "machine_compliance");
  EXPECT_GT(compliance.absorption, 0.95);
  ASSERT_TRUE(compliance.smallest_seen.has_value());
  EXPECT_NEAR(signal(plain, printed(*compliance.smallest_seen)), kVisibleSignal, 0.1 * kVisibleSignal);
}

}  // namespace
}  // namespace nacre::diagnosis
