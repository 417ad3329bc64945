// What the laboratory can hide: every effect at zero is nothing, every effect is something, and the laws that it shares
// in name with the simulator's library mean the same, though no code is shared.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "base/result.hpp"
#include "laboratory/draw.hpp"
#include "laboratory/effect_kinds.hpp"
#include "laboratory/fracture_bench.hpp"
#include "laboratory/hidden_coupon.hpp"
#include "laboratory/laboratory.hpp"
#include "laboratory/laboratory_file.hpp"
#include "laboratory/modulus_bench.hpp"
#include "material/criterion_strengths.hpp"
#include "material/effect_library.hpp"
#include "material/extensions.hpp"
#include "material/pulled_bar.hpp"
#include "measurement/pauses.hpp"
#include "pattern/random_pattern.hpp"
#include "tester/loading.hpp"
#include "tester/paused_pull.hpp"
#include "tester/tensile.hpp"
#include "tester/toughness.hpp"

namespace nacre::laboratory {
namespace {

using tester::TestKind;

constexpr double kYoungPa = 1e9, kPoisson = 0.3;

pattern::Design some_pattern() {
  RandomStream random(4, "hidden effects");
  return pattern::random_pattern(random);
}

Truth unaffected_truth() {
  Truth truth = draw_truth(33, tester::Fidelity::tiny);
  truth.effects = {};
  return truth;
}

Truth with(const EffectKind& kind, double value) {
  Truth truth = unaffected_truth();
  truth.effects.*kind.value = value;
  if (kind.second.value != nullptr) truth.effects.*kind.second.value = kind.second.drawn_minimum;
  return truth;
}

/// Everything that the benches are given, as text.
std::string made(const Truth& truth) {
  std::string text;
  const auto add = [&](const Raster& raster) {
    double sum = 0.0;
    for (std::size_t e = 0; e < raster.mu_pa.size(); ++e)
      sum += static_cast<double>(e % 977 + 1) *
             (raster.mu_pa[e] + raster.lambda_pa[e] +
              (std::isfinite(raster.threshold_j_per_m3[e]) ? raster.threshold_j_per_m3[e] : 0.0));
    const HiddenLaw& law = raster.law;
    text += fmt::format("{:a} {} {} {} {} {} {} {} {} {} ", sum, law.yield_pa.size(), law.inverse_limit.size(),
                        law.eigenstrain.size(), law.overstress.size(), law.linear_softening, law.drawn_out_softening,
                        law.tension_only, raster.grips.side_stiffness_pa, raster.grips.tilt);
  };
  const pattern::Design design = some_pattern();
  for (const double orientation_deg : {0.0, 90.0}) {
    const Making making{.orientation_deg = orientation_deg};
    add(modulus_raster(truth, design, making, specimen_size(TestKind::modulus, truth.fidelity)));
    add(fracture_raster(truth, design, making, specimen_size(TestKind::toughness, truth.fidelity, truth.effects)));
  }
  return text;
}

/// Everything that a record adds to a response, on the second of two machines.
measurement::SpecimenRecord recorded(const Truth& truth, TestKind test) {
  TrueResponse response{.modulus_pa = 1e9, .curve = {{0.0, 0.01, 0.02}, {0.0, 1e6, 2e5}}, .remark = {}};
  return record_specimen(
      truth, {.design = some_pattern(), .test = test, .conditions = {}, .fidelity = truth.fidelity}, response,
      {.specimen = "s", .batch = "batch-3", .print_order = 7, .on_second_machine = true, .number = 3});
}

// `nacre measure` counts its batches from 1, a game from its round 0.
TEST(HiddenEffects, BatchesDriftFromTheFirstOne) {
  Truth truth = unaffected_truth();
  truth.effects.batch_drift = 0.1;
  const auto modulus = [&](const std::string& batch) {
    return *record_specimen(truth, {.design = some_pattern(), .fidelity = truth.fidelity},
                            TrueResponse{.modulus_pa = 1e9}, {.specimen = "s", .batch = batch, .print_order = 7})
                .modulus_pa;
  };
  for (const auto& [first, second, third] :
       {std::array{"batch-1", "batch-2", "batch-3"}, std::array{"round-0", "round-1", "round-2"}}) {
    EXPECT_DOUBLE_EQ(modulus(first), modulus("without a number"));
    EXPECT_NEAR(modulus(second) / modulus(first), 1.1, 1e-9) << second;
    EXPECT_NEAR(modulus(third) / modulus(second), 1.1, 1e-9) << third;
  }
}

TEST(HiddenEffects, AtZeroAreNothing) {
  const std::string base = made(unaffected_truth());
  for (const EffectKind& kind : effect_kinds()) {
    EXPECT_EQ(made(with(kind, 0.0)), base) << kind.name;
    for (const TestKind test : {TestKind::modulus, TestKind::toughness})
      EXPECT_EQ(recorded(with(kind, 0.0), test), recorded(unaffected_truth(), test)) << kind.name;
  }
}

TEST(HiddenEffects, AreSomethingAtEveryDrawnSize) {
  const Making faster{.strain_rate_per_s = 6.17e-3};
  for (const EffectKind& kind : effect_kinds())
    for (const double value : {kind.drawn_minimum, kind.drawn_maximum}) {
      const Truth truth = with(kind, value);
      const bool shows =
          made(truth) != made(unaffected_truth()) ||
          recorded(truth, TestKind::modulus) != recorded(unaffected_truth(), TestKind::modulus) ||
          recorded(truth, TestKind::toughness) != recorded(unaffected_truth(), TestKind::toughness) ||
          homogeneous_modulus(truth, 0.7, faster) != homogeneous_modulus(unaffected_truth(), 0.7, faster);
      EXPECT_TRUE(shows) << kind.name << " " << value;
    }
}

TEST(HiddenEffects, HaveTheNamesAndFamiliesOfTheLibraryOrNone) {
  int in_library = 0;
  for (const EffectKind& kind : effect_kinds()) {
    const material::Effect* effect = material::find_effect(kind.name);
    EXPECT_EQ(effect != nullptr, kind.in_library) << kind.name;
    if (effect != nullptr) {
      EXPECT_EQ(effect->family, kind.family) << kind.name;
      ++in_library;
    }
  }
  // A shift by temperature is no hidden effect: the laboratory always has it. Its air is that of ISO 291, and its
  // specimens are new. Of overstresses by phase it has that of the soft one, as another form: of layouts none is tried.
  EXPECT_EQ(std::ranges::count(effect_kinds(), "soft_rate_dependence", &EffectKind::name), 1);
  const auto shown = [](const material::Effect& law) {
    return law.law_of != "temperature" && law.law_of != "humidity" && law.law_of != "age" &&
           law.name != "rate_by_phase";
  };
  const auto all = std::ssize(material::effect_library()) + std::ranges::count_if(material::condition_laws(), shown);
  EXPECT_EQ(in_library, static_cast<int>(all)) << "the laboratory can hide every effect";
}

TEST(LaboratoryFile, EffectsWithTwoNumbersReadBackAndRefuseOthers) {
  const Truth truth = parse_laboratory("seed = 2\n[[effect]]\nname = \"rate_dependence\"\nvalue = [0.5, 12.0]\n", "a");
  EXPECT_EQ(truth.effects.rate_overstress, 0.5);
  EXPECT_EQ(truth.effects.rate_relaxation_s, 12.0);
  EXPECT_EQ(parse_laboratory(to_toml(truth), "b"), truth);
  const auto refusal = [](const char* value) -> std::string {
    try {
      parse_laboratory(fmt::format("[[effect]]\nname = \"rate_dependence\"\nvalue = {}\n", value), "lab.toml");
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refusal("[0.5]"), testing::HasSubstr(":3:9: effect.value: expected two numbers"));
  EXPECT_THAT(refusal("[0.5, -1.0]"), testing::HasSubstr("expected a number from 0.001"));
  const Truth drawn = parse_laboratory("seed = 2\n[[effect]]\nname = \"rate_dependence\"\n", "a");
  EXPECT_GT(drawn.effects.rate_relaxation_s, 0.9);
}

/// A strip of one material without notch.
Raster strip(int rows = 12) {
  const material::Lame lame = material::lame_from_engineering(kYoungPa, kPoisson);
  constexpr int columns = 16;
  Raster raster;
  raster.columns = columns;
  raster.rows = rows;
  const auto elements = static_cast<std::size_t>(columns * rows);
  raster.mu_pa.assign(elements, lame.mu_pa);
  raster.lambda_pa.assign(elements, lame.lambda_pa);
  raster.threshold_j_per_m3.assign(elements, 5e6);
  return raster;
}

std::vector<double> everywhere(double value) { return std::vector<double>(strip().mu_pa.size(), value); }

tester::Curve pulled(const Raster& raster, double strain_limit) {
  return pull_to_separation(raster, {.gamma_per_s = 1e6, .strain_limit = strain_limit}).value().curve;
}

/// Largest difference between a strip of the bench and a bar of the simulator's law, over the largest stress.
double difference(const Raster& raster, const material::ExtendedLaw& law, double end) {
  const tester::Curve curve = pulled(raster, end);
  material::PulledBar bar(law);
  double worst = 0.0, largest = 0.0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const double stress_pa = bar.pull(curve.strain[i], (curve.strain[i] - curve.strain[i - 1]) / 20.0);
    largest = std::max(largest, std::abs(stress_pa));
    if (curve.strain[i] > 0.008) worst = std::max(worst, std::abs(stress_pa - curve.stress_pa[i]));
  }
  return worst / largest;
}

material::ExtendedLaw base_law() { return {.lame = material::lame_from_engineering(kYoungPa, kPoisson)}; }

TEST(HiddenLaw, NamesMeanWhatTheyMeanInTheSimulator) {
  Raster flow = strip(), gent = strip(), branch = strip();
  material::ExtendedLaw flow_law = base_law(), gent_law = base_law(), branch_law = base_law();
  flow.law.yield_pa = everywhere(flow_law.yield_pa = 2e7);
  gent.law.inverse_limit = everywhere(gent_law.inverse_limit = 20.0);
  branch.law.overstress = everywhere(branch_law.overstress = 0.6);
  branch.law.relaxation_s = branch_law.relaxation_time_s = 8e-4;
  EXPECT_LT(difference(flow, flow_law, 0.05), 0.03);
  EXPECT_LT(difference(gent, gent_law, 0.05), 0.03);
  EXPECT_LT(difference(branch, branch_law, 0.03), 0.03);
  EXPECT_GT(difference(flow, base_law(), 0.05), 0.2) << "and they are no small things";
  EXPECT_GT(difference(branch, base_law(), 0.03), 0.1);
}

TEST(HiddenLaw, NothingHiddenInTheHiddenKernelIsThePlainKernel) {
  Raster notched = strip();
  for (int column = 0; column < 6; ++column) {
    const auto e = static_cast<std::size_t>(8 * notched.columns + column);
    notched.mu_pa[e] = notched.lambda_pa[e] = 0.0;
  }
  std::fill(notched.threshold_j_per_m3.begin(), notched.threshold_j_per_m3.end(), 5e5);
  Raster hidden = notched;
  hidden.law.overstress = everywhere(1e-12);
  hidden.law.relaxation_s = 1.0;
  EXPECT_NEAR(tester::area_under(pulled(hidden, 0.3)) / tester::area_under(pulled(notched, 0.3)), 1.0, 0.02);
}

// A single row, which softens as a whole: of several one may take all of it, which the last bits decide.
TEST(HiddenLaw, SofteningTakesMoreWorkThanBreakingAtOnce) {
  Raster sharp = strip(1);
  std::fill(sharp.threshold_j_per_m3.begin(), sharp.threshold_j_per_m3.end(), 5e5);
  Raster linear = sharp, drawn_out = sharp;
  linear.law.linear_softening = 1.0;
  drawn_out.law.drawn_out_softening = 1.0;
  const double at_once = tester::area_under(pulled(sharp, 0.3));
  EXPECT_NEAR(at_once, 5e5, 0.1 * 5e5);
  for (const Raster& raster : {linear, drawn_out}) {
    const double work = tester::area_under(pulled(raster, 0.3));
    EXPECT_GT(work, 1.5 * at_once);
    EXPECT_LT(work, 2.1 * at_once);
  }
}

TEST(HiddenLaw, AShrunkStripComesToRestAndPullsAsBefore) {
  Raster shrunk = strip();
  shrunk.law.eigenstrain = everywhere(-0.01);
  const tester::Curve curve = pulled(shrunk, 0.03), base = pulled(strip(), 0.03);
  EXPECT_LT(std::abs(curve.stress_pa[1]), 0.02 * base.stress_pa.back());
  // Per width as printed.
  EXPECT_NEAR(curve.stress_pa.back() / base.stress_pa.back(), 0.99, 0.01);
}

TEST(HiddenCoupons, AreUnloadedAsOrdered) {
  Truth truth = unaffected_truth();
  Experiment experiment{.design = pattern::Mixture{1.0},
                        .test = tester::TestKind::tensile,
                        .conditions = {},
                        .fidelity = tester::Fidelity::full,
                        .loading = {{0.02, 0.005, 0.022}}};
  const auto stress_at_low_point = [&] {
    const tester::Curve curve = respond(truth, experiment).value().curve;
    const auto turn = std::find(curve.strain.begin(), curve.strain.end(), 0.005) - curve.strain.begin();
    EXPECT_EQ(curve.strain.back(), 0.022);
    EXPECT_NEAR(*std::max_element(curve.strain.begin(), curve.strain.begin() + turn), 0.02, 1e-12);
    return curve.stress_pa.at(static_cast<std::size_t>(turn));
  };
  const double elastic = stress_at_low_point();
  EXPECT_GT(elastic, 0.0);
  truth.effects.rigid_yield_pa = 3e7;  // flows before 2 %: what it flowed is missing on the way back
  EXPECT_LT(stress_at_low_point(), 0.2 * elastic);
  experiment.test = tester::TestKind::modulus;
  EXPECT_FALSE(respond(truth, experiment)) << "nothing else is unloaded";
}

// Pauses mean in the laboratory what they mean in the tester: hold, set at zero force, set after a dwell.
TEST(HiddenCoupons, AreHeldAndLeftAsInTheTester) {
  struct Law {
    double rigid_fraction;
    HiddenEffects hidden;
    material::Extensions simulated;
  };
  const tester::Loading loading{{0.015}, {20.0}, 200.0};
  for (const Law& law :
       {Law{1.0, {.rigid_yield_pa = 1.2e7}, {{"rigid_yield", {1.2e7}}}},
        Law{1.0, {.rate_overstress = 0.6, .rate_relaxation_s = 30.0}, {{"rate_dependence", {0.6, 30.0}}}},
        Law{0.8, {.rate_exponent = 0.2, .rate_exponent_ratio = 0.4}, {{"rate_power_law", {0.2, 0.7, 0.4}}}},
        Law{0.8,
            {.two_overstresses = 0.5, .shorter_relaxation_s = 0.05},
            {{"rate_prony", {0.5, 0.05, 0.5, 1000.0}}}}}) {
    Truth truth = unaffected_truth();
    truth.coupons = {};
    truth.effects = law.hidden;
    tester::Simulation simulation{
        pattern::Mixture{law.rigid_fraction}, material::default_parameters(), {}, tester::Fidelity::tiny};
    simulation.parameters.modulus = truth.modulus;
    simulation.parameters.toughness = truth.toughness;
    simulation.parameters.extensions = law.simulated;
    const std::string& flows = law.simulated.begin()->first;
    const Experiment experiment{.design = pattern::Mixture{law.rigid_fraction},
                                .test = tester::TestKind::tensile,
                                .fidelity = truth.fidelity,
                                .loading = loading};
    const auto measured = measurement::read_pauses(respond(truth, experiment)->curve, loading);
    const auto expected = tester::pull_with_pauses(simulation, loading).value();
    EXPECT_NEAR(measured.held_share.value(), *expected.held_stress_pa / expected.turn_stress_pa, 2e-3) << flows;
    EXPECT_NEAR(measured.set_share.value(), *expected.set_strain / 0.015, 1e-3) << flows;
    EXPECT_NEAR(measured.dwelled_share.value(), *expected.dwelled_strain / 0.015, 1e-3) << flows;
  }
}

TEST(HiddenCoupons, YieldStiffenAndRelaxAsTheSimulatorsDo) {
  Truth truth = unaffected_truth();
  const auto differs = [&](double rigid_fraction, double strain, const material::Extensions& extensions) {
    const tester::Curve curve = coupon_curve(truth, rigid_fraction, {}, tester::strain_path({{strain}}, strain / 49.0));
    tester::Simulation simulation{.design = pattern::Mixture{rigid_fraction},
                                  .parameters = material::thesis_parameters(),
                                  .conditions = {},
                                  .fidelity = tester::Fidelity::full};
    simulation.parameters.modulus = truth.modulus;
    simulation.parameters.extensions = extensions;
    const tester::Curve simulated = tester::test_tensile(simulation, curve.strain).value();
    double worst = 0.0;
    for (std::size_t i = 1; i < curve.size(); ++i)
      worst = std::max(worst, std::abs(curve.stress_pa[i] / simulated.stress_pa[i] - 1.0));
    return worst;
  };
  truth.effects.rigid_yield_pa = 3e7;
  EXPECT_LT(differs(1.0, 0.02, {{"rigid_yield", {3e7}}}), 0.005);
  truth.effects = {};
  truth.effects.rate_overstress = 0.5;
  truth.effects.rate_relaxation_s = 8.0;
  EXPECT_LT(differs(0.7, 0.02, {{"rate_dependence", {0.5, 8.0}}}), 0.005);
  truth.effects.rate_relaxation_s = 200.0;
  EXPECT_LT(differs(0.0, 0.6, {{"rate_dependence", {0.5, 200.0}}}), 0.005);
  truth.effects = {};
  truth.effects.soft_stiffening_limit = 0.6;
  EXPECT_LT(differs(0.0, 0.4, {{"soft_stiffening", {0.6}}}), 0.005);
}

TEST(RateDependence, StiffensTheModulusAsTheSimulatorDoes) {
  Truth truth = unaffected_truth();
  truth.effects.rate_overstress = 0.5;
  truth.effects.rate_relaxation_s = 8.0;
  const double plain = homogeneous_modulus(unaffected_truth(), 1.0), slow = homogeneous_modulus(truth, 1.0),
               fast = homogeneous_modulus(truth, 1.0, {.strain_rate_per_s = 10.0});
  EXPECT_NEAR(slow / plain, material::rate_stiffening({.overstress = 0.5, .relaxation_time_s = 8.0}, 6.17e-4), 1e-12);
  EXPECT_NEAR(fast / plain, 1.5, 1e-3);
}

TEST(StrengthScatter, GivesEveryReplicateVoxelsOfItsOwn) {
  Truth truth = unaffected_truth();
  truth.replicates = 2;
  truth.strength_cv = 0.18;
  truth.effects.strength_scatter = 0.24;
  const Experiment experiment{
      .design = some_pattern(), .test = TestKind::toughness, .conditions = {}, .fidelity = tester::Fidelity::tiny};
  const Result<TrueResponse> response = respond(truth, experiment);
  ASSERT_TRUE(response.has_value()) << response.error().message;
  ASSERT_EQ(response->other_curves.size(), 1u);
  EXPECT_NE(response->other_curves[0], response->curve);
  Experiment of_three = experiment;
  of_three.specimens = 3;
  const std::vector<tester::Curve> others = respond(truth, of_three)->other_curves;
  ASSERT_EQ(others.size(), 2u);
  EXPECT_EQ(others[0], response->other_curves[0]) << "the second specimen is the same one";
  EXPECT_NE(others[1], others[0]);
  // So does the variation that every print has, to which the effect adds.
  truth.effects = {};
  truth.strength_cv = 0.3;
  EXPECT_EQ(respond(truth, experiment)->curve, response->curve);
  EXPECT_EQ(respond(truth, experiment)->other_curves, response->other_curves);
}

/// T of the laboratory over T of the testers for one design, both without scatter.
double laboratory_over_tester(const material::FailureCriterion& criterion) {
  Truth truth = unaffected_truth();
  truth.toughness = material::with_strengths(
      truth.toughness, material::strength_ratio(criterion) / material::strength_ratio(truth.criterion));
  truth.criterion = criterion;
  truth.strength_cv = 0.0;
  const Experiment experiment{
      .design = some_pattern(), .test = TestKind::toughness, .conditions = {}, .fidelity = tester::Fidelity::tiny};
  tester::Simulation simulation{.design = experiment.design,
                                .parameters = material::thesis_parameters(),
                                .conditions = {},
                                .fidelity = experiment.fidelity};
  simulation.parameters.toughness = truth.toughness;
  simulation.parameters.criterion = criterion;
  const double ratio =
      tester::area_under(respond(truth, experiment)->curve) / tester::test_toughness(simulation)->toughness_pa;
  std::printf("%s: laboratory over testers %.3f\n", std::string(to_string(criterion.kind)).c_str(), ratio);
  return ratio;
}

TEST(HiddenCriteria, NeighbourhoodsAbsorbWhatTheTestersDo) {
  EXPECT_NEAR(laboratory_over_tester({.kind = material::CriterionKind::neighbourhood}), 1.0, 0.25) << "one crack each";
}

TEST(HiddenCriteria, WithALengthKeepTheStrengthAndDrawTailsOut) {
  using material::CriterionKind;
  const SpecimenSize size = specimen_size(TestKind::toughness, tester::Fidelity::tiny);
  const auto of = [&](CriterionKind kind, double progressive_damage) {
    Truth truth = unaffected_truth();
    truth.criterion.kind = kind;
    truth.effects.progressive_damage = progressive_damage;
    return fracture_raster(truth, some_pattern(), {}, size);
  };
  const Raster elements = of(CriterionKind::element, 1.0);
  EXPECT_EQ(elements.law.linear_softening, 1.0);
  for (const CriterionKind kind : {CriterionKind::neighbourhood, CriterionKind::crack_band}) {
    const Raster raster = of(kind, 1.0);
    EXPECT_EQ(raster.threshold_j_per_m3[0], 0.5 * elements.threshold_j_per_m3[0]);
    EXPECT_EQ(raster.law.linear_softening, kind == CriterionKind::crack_band ? 9.0 : 3.0);
    EXPECT_EQ(raster.neighbourhood_m > 0.0, kind == CriterionKind::neighbourhood);
  }
  EXPECT_EQ(of(CriterionKind::crack_band, 0.0).law.linear_softening, 7.0) << "1 + v0 = 4 on elements of h";
}

// A single row, and neighbourhoods of one element.
TEST(HiddenCriteria, WhatANeighbourhoodFailsSoftens) {
  Raster sharp = strip(1);
  std::fill(sharp.threshold_j_per_m3.begin(), sharp.threshold_j_per_m3.end(), 5e5);
  sharp.neighbourhood_m = kElementM;
  Raster linear = sharp;
  linear.law.linear_softening = 1.0;
  const double at_once = tester::area_under(pulled(sharp, 0.3)), work = tester::area_under(pulled(linear, 0.3));
  EXPECT_NEAR(at_once, 5e5, 0.1 * 5e5);
  EXPECT_GT(work, 1.5 * at_once);
  EXPECT_LT(work, 2.1 * at_once);
}

TEST(Grips, FrictionStiffensASquareAndTiltKeepsASymmetricModulus) {
  Raster held = strip(), tilted = strip();
  held.grips.side_stiffness_pa = 10.0 * kYoungPa;
  tilted.grips.tilt = 0.5;
  const double plain = pull_elastically(strip()).value();
  EXPECT_GT(pull_elastically(held).value(), 1.005 * plain);
  EXPECT_NEAR(pull_elastically(tilted).value() / plain, 1.0, 1e-9);
}

}  // namespace
}  // namespace nacre::laboratory
