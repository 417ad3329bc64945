#include "diagnosis/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/candidate_effects.hpp"
#include "diagnosis/candidates.hpp"
#include "material/extensions.hpp"
#include "synthetic_set.hpp"

namespace nacre::diagnosis {
namespace {

class Plans : public testing::Test {
 protected:
  Plans() {
    settings_.start = material::thesis_parameters();
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

TEST_F(Plans, AnUnmodelledCauseIsCountedLikeAKnownEffect) {
  // The same change of the same specimens: as a signature of an effect, and as a difference between two sets of values.
  const SyntheticSet set{.patterns = 10, .twins = 3, .noise = 0.0};
  const material::Effect& mixing = *material::find_effect("droplet_mixing");
  const double typical = material::value_at_strength(mixing.parameters.front(), FitRules{}.sizes[FitRules{}.typical]);
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
  settings_.start = material::thesis_parameters();
  settings_.ranges = material::thesis_ranges();
  EXPECT_LT(own, 0.6 * planned_yield());
}

// At one rate a relaxing material is a stiffer one; a hold and a dwell tell it from that, and from one that flows.
TEST_F(Plans, PausesShowWhatAPullAtOneRateDoesNot) {
  auto coupons = synthetic_coupons(settings_.start, {1e-3}, 3, 0.0, 1);
  const double pulled = planned(coupons, "rate_dependence").signal_to_noise;
  for (measurement::SpecimenRecord& each : coupons) {
    each.curve = {};
    each.other_columns["loading"] = "strain 0.015 hold 60 unload dwell 600";
  }
  const PlannedEffect paused = planned(coupons, "rate_dependence");
  EXPECT_GT(paused.signal_to_noise, 1.5 * pulled);
  EXPECT_EQ(paused.status, PlanStatus::told_apart);
}

// Flow has no signature until stress reaches the yield stress: the smallest effect is where it begins to show.
TEST_F(Plans, AYieldStressIsSeenFromWhereItShows) {
  const auto pulled = [&](const material::ParameterSet& truth) { return synthetic_coupons(truth, {1e-3}, 3, 0.0, 1); };
  const auto plain = pulled(settings_.start);
  const PlannedEffect flow = planned(plain, "rigid_yield");
  ASSERT_TRUE(flow.smallest_seen.has_value());
  EXPECT_GT(signal(plain, pulled(with("rigid_yield", *flow.smallest_seen))), NameRules{}.visible_signal);
  EXPECT_LT(signal(plain, pulled(with("rigid_yield", 1.4 * *flow.smallest_seen))), NameRules{}.visible_signal);
}

// A machine that gives way looks nearly like softer materials on specimens of all stiffnesses; the rest is visible.
TEST_F(Plans, AnEffectThatTheBaseMostlyImitatesIsSeenByTheRest) {
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
  EXPECT_NEAR(signal(plain, printed(*compliance.smallest_seen)), NameRules{}.visible_signal,
              0.1 * NameRules{}.visible_signal);
}

// Thin twins of 1.5 mm, where a plan proposes such of 1.6 mm: what the set shows does not depend on which of the names
// is the first.
TEST_F(Plans, ProposalsTakeNothingAwayFromTheSet) {
  auto specimens = synthetic_specimens({.patterns = 9, .twins = 2, .replicates = 2}, settings_.start);
  const std::size_t upright = specimens.size();
  for (std::size_t i = 0; i < upright; i += 4) {
    specimens.push_back(specimens[i]);
    specimens.back().specimen = "thin of " + specimens[i].specimen;
    specimens.back().conditions.thickness_mm = 1.5;
  }
  const Plan alone = plan_diagnosis(specimens, settings_, kScatter, false),
             with_proposals = plan_diagnosis(specimens, settings_, kScatter, true);
  ASSERT_FALSE(with_proposals.additions.empty());
  for (std::size_t k = 0; k < alone.effects.size(); ++k) {
    if (alone.effects[k].status == PlanStatus::not_shown) continue;
    EXPECT_NEAR(with_proposals.effects[k].signal_to_noise, alone.effects[k].signal_to_noise,
                1e-6 * alone.effects[k].signal_to_noise)
        << alone.effects[k].name;
  }
}

// A diagnosis of moduli alone has few candidate effects (METHODS.md, "Diagnosis", 3): a plan promises no others, nor
// has them as rivals, though it proposes coupons too.
TEST_F(Plans, ModuliAlonePromiseOnlyTheirCandidates) {
  const auto moduli = synthetic_specimens({.patterns = 10, .twins = 4, .replicates = 2}, settings_.start);
  const Plan plan = plan_diagnosis(moduli, settings_, kScatter);
  const auto is_candidate = [](const std::string& name) {
    return is_identified_by_moduli(*material::find_effect(name));
  };
  for (const PlannedEffect& effect : plan.effects) {
    EXPECT_TRUE(is_candidate(effect.name) || effect.status == PlanStatus::not_shown) << effect.name;
    EXPECT_TRUE(effect.nearest_rival.empty() || is_candidate(effect.nearest_rival)) << effect.nearest_rival;
  }
  bool coupons_show_more = false;
  for (const PlannedAddition& addition : plan.additions) {
    const bool coupons = addition.specimens.front().starts_with("tensile");
    for (const auto& change : addition.changes) {
      EXPECT_TRUE(coupons || is_candidate(change.effect)) << addition.words << ": " << change.effect;
      coupons_show_more = coupons_show_more || (coupons && !is_candidate(change.effect));
    }
  }
  EXPECT_TRUE(coupons_show_more);
}

TEST_F(Plans, FewSpecimensAreToldWhatToAdd) {
  const auto specimens = synthetic_specimens({.patterns = 3, .twins = 0}, settings_.start);
  const Plan plan = plan_diagnosis(specimens, settings_, kScatter);
  EXPECT_TRUE(std::ranges::none_of(plan.effects, [](const PlannedEffect& effect) {
    return effect.name == "interface_anisotropy" && effect.status == PlanStatus::told_apart;
  }));
  EXPECT_FALSE(plan.additions.empty());
  EXPECT_THROW(plan_diagnosis({}, settings_, kScatter, false), NothingMeasured);
}

}  // namespace
}  // namespace nacre::diagnosis
