#include "diagnosis/fracture_plan.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/kept_emulator.hpp"
#include "diagnosis/planned_runs.hpp"
#include "material/effect_library.hpp"
#include "pattern/random_pattern.hpp"
#include "sysid/eta.hpp"

namespace nacre::diagnosis {
namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::Not;

constexpr int kBroken = 14, kPieces = 4;

std::vector<pattern::Pattern> planned_layouts() {
  RandomStream drawn(3, "test/patterns");
  return pattern::stratified_patterns(kBroken, drawn);
}

/// Stands for the fracture tester: a triangle whose peak and end depend on eta and on each effect, in a way of their
/// own over the layouts.
tester::Curve curve_of(const pattern::Design& design, const material::ParameterSet& set, double chance) {
  const double place = 10.0 * rigid_position(design);
  const material::ToughnessVector eta = to_vector(set.toughness),
                                  centre = to_vector(material::default_parameters().toughness);
  double log_peak = 15.0 + 0.1 * place + 0.3 * chance, log_end = -3.0 + chance;
  for (const std::size_t k : sysid::kSearchedEta) {
    const double moved = std::log(eta[k] / centre[k]);
    log_peak += 0.2 * std::cos(place + static_cast<double>(k)) * moved;
    log_end += 0.2 * std::sin(place * 0.5 + static_cast<double>(k)) * moved;
  }
  double own = 0.0;
  for (const material::Effect* effect : fracture_effects()) {
    own += 1.7;
    const auto found = set.extensions.find(effect->name);
    if (found == set.extensions.end()) continue;
    const double strength = material::strength_of(effect->parameters.front(), found->second.front());
    log_peak += strength * std::cos(own * place + own);
    log_end += strength * std::sin(0.7 * own * place + own);
  }
  tester::Curve curve;
  for (int i = 0; i <= 20; ++i) {
    curve.strain.push_back(std::exp(log_end) * i / 20.0);
    curve.stress_pa.push_back(std::exp(log_peak) * i / 20.0);
  }
  curve.strain.push_back(std::exp(log_end) * 1.01);
  curve.stress_pa.push_back(0.0);
  return curve;
}

sysid::Prediction fractured(const pattern::Design& design, const material::ParameterSet& set, double chance) {
  tester::Curve curve = curve_of(design, set, chance);
  return {.modulus_pa = {}, .toughness_pa = tester::area_under(curve), .specimens = 1, .curve = std::move(curve)};
}

std::vector<measurement::SpecimenRecord> pulled(const material::ParameterSet& truth) {
  RandomStream chance(9, "test/specimens");
  std::vector<measurement::SpecimenRecord> specimens;
  for (const pattern::Pattern& layout : planned_layouts())
    for (int i = 0; i < kPieces; ++i) {
      measurement::SpecimenRecord& specimen = specimens.emplace_back();
      specimen.specimen = layout.key() + "/" + std::to_string(i);
      specimen.design = layout;
      specimen.test = tester::TestKind::toughness;
      const sysid::Prediction shown = fractured(layout, truth, 0.03 * chance.normal());
      specimen.toughness_pa = shown.toughness_pa;
      specimen.curve = shown.curve;
    }
  return specimens;
}

/// Models that a calibration is taken to have evaluated about the defaults.
std::vector<sysid::EvaluatedModel> evaluated(int count) {
  RandomStream random(4, "test/search");
  std::vector<sysid::EvaluatedModel> models;
  for (int k = 0; k < count; ++k) {
    material::ParameterSet set = material::default_parameters();
    material::ToughnessVector eta = to_vector(set.toughness);
    for (const std::size_t i : sysid::kSearchedEta) eta[i] *= std::exp(0.4 * random.normal());
    set.toughness = material::toughness_from_vector(eta);
    models.push_back({set, tester::kFirstCalibrationSpecimen + k});
  }
  return models;
}

DiagnosisSettings settings_for_plans() {
  DiagnosisSettings settings;
  settings.start = material::default_parameters();
  settings.fidelity = tester::Fidelity::tiny;
  settings.bootstraps = 1000;
  settings.check_discretisation = false;
  return settings;
}

/// All plans, as the stand-in breaks them.
std::vector<SimulatedPlan> simulated_plans(const std::vector<measurement::SpecimenRecord>& specimens,
                                           const std::vector<sysid::EvaluatedModel>& known, int simulations) {
  RandomStream chance(11, "test/simulated");
  std::vector<SimulatedPlan> done;
  while (auto plan = next_fractures(specimens, known, simulations, settings_for_plans(), done)) {
    std::vector<std::vector<sysid::Prediction>> predictions;
    for (const sysid::WantedEvaluation& wanted : plan->wanted) {
      auto& own = predictions.emplace_back();
      for (const std::size_t item : wanted.items)
        own.push_back(fractured(plan->measured[item].design, wanted.parameters, 0.03 * chance.normal()));
    }
    done.push_back({*std::move(plan), std::move(predictions)});
  }
  return done;
}

/// Models of all plans in turn.
std::vector<sysid::WantedEvaluation> wanted_by(const std::vector<SimulatedPlan>& done) {
  std::vector<sysid::WantedEvaluation> wanted;
  for (const SimulatedPlan& each : done) wanted.insert(wanted.end(), each.plan.wanted.begin(), each.plan.wanted.end());
  return wanted;
}

int cost(const std::vector<SimulatedPlan>& done, std::size_t known) {
  const std::vector<sysid::WantedEvaluation> wanted = wanted_by(done);
  std::size_t simulations = 0;
  for (std::size_t k = known; k < wanted.size(); ++k) simulations += wanted[k].items.size();
  return static_cast<int>(simulations);
}

/// Names of the effects that some model of the plans has.
std::vector<std::string> effects_of(const std::vector<SimulatedPlan>& done) {
  std::vector<std::string> names;
  for (const sysid::WantedEvaluation& wanted : wanted_by(done))
    for (const auto& [name, values] : wanted.parameters.extensions)
      if (std::ranges::count(names, name) == 0) names.push_back(name);
  return names;
}

TEST(FracturePlan, StaysWithinItsBudgetAndSaysWhatThatDoesNotPay) {
  const auto specimens = pulled(material::default_parameters());
  const auto known = evaluated(12);
  const std::size_t all = fracture_effects().size();
  for (const int sets : {0, 6, 7, 10, 16, 30}) {
    const auto done = simulated_plans(specimens, known, sets * kBroken + 3);
    if (sets < 7) {
      EXPECT_TRUE(done.empty()) << "the start, three models about the fit, and the three effects that moduli identify";
      continue;
    }
    ASSERT_EQ(done.size(), 3u);
    EXPECT_LE(cost(done, known.size()), sets * kBroken + 3);
    const std::vector<std::string>& unpaid = done.back().plan.unaffordable;
    EXPECT_EQ(effects_of(done).size(), std::min<std::size_t>(all, sets - 4));
    EXPECT_EQ(effects_of(done).size() + unpaid.size(), all);
    for (const std::string& name : unpaid) EXPECT_THAT(effects_of(done), Not(Contains(name)));
  }
}

TEST(FracturePlan, WhatACalibrationEvaluatedIsAskedForAsItBrokeIt) {
  const auto known = evaluated(12);
  const auto wanted = wanted_by(simulated_plans(pulled(material::default_parameters()), known, 300));
  ASSERT_GT(wanted.size(), known.size());
  std::vector<int> numbers;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    if (k < known.size()) EXPECT_EQ(wanted[k].parameters, known[k].parameters);
    if (k < known.size()) EXPECT_EQ(wanted[k].first_specimen, known[k].specimen);
    EXPECT_THAT(numbers, Not(Contains(wanted[k].first_specimen))) << "a crack of its own in every model";
    numbers.push_back(wanted[k].first_specimen);
  }
}

TEST(FracturePlan, FewEvaluatedModelsAreAddedToFirst) {
  const auto done = simulated_plans(pulled(material::default_parameters()), evaluated(2), 1000);
  ASSERT_FALSE(done.empty());
  EXPECT_GE(std::ssize(done.front().plan.wanted), settings_for_plans().procedure.emulator.models_in_turn.front());
  EXPECT_THAT(simulated_plans(pulled(material::default_parameters()), {}, 9 * kBroken), IsEmpty())
      << "base models alone would know no effect";
}

// The calibration ended far from the truth, and effects would be simulated where nothing is measured.
TEST(FracturePlan, EffectsAreSimulatedAboutWhatTheTestsSay) {
  material::ParameterSet truth = material::default_parameters();
  truth.toughness.w_vw_j_per_m3 *= 2.0;
  truth.toughness.e_tb_pa *= 0.5;
  const auto done = simulated_plans(pulled(truth), evaluated(14), 20 * kBroken);
  ASSERT_EQ(done.size(), 3u);
  const auto error = [&](const SimulatedPlan& each) {
    double squares = 0.0;
    for (const pattern::Pattern& layout : planned_layouts())
      squares += std::pow(std::log(*fractured(layout, each.plan.centre, 0.0).toughness_pa /
                                   *fractured(layout, truth, 0.0).toughness_pa),
                          2);
    return std::sqrt(squares / kBroken);
  };
  EXPECT_GT(error(done.front()), 0.05);
  EXPECT_LT(error(done.back()), 0.2 * error(done.front()));
}

TEST(FracturePlan, ADiagnosisFromWhatOthersSimulatedNamesWhatActs) {
  material::ParameterSet truth = evaluated(30).back().parameters;
  truth.extensions["blunt_notch"] = {0.012};
  const auto specimens = pulled(truth);
  DiagnosisSettings own = settings_for_plans();
  own.fractures = simulated_fractures(simulated_plans(specimens, evaluated(14), 16 * kBroken));
  EXPECT_THAT(own.fractures->unaffordable, IsEmpty());
  const Diagnosis diagnosis = diagnose(specimens, own);
  ASSERT_EQ(diagnosis.verdict, Verdict::named) << diagnosis.summary;
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_EQ(diagnosis.effects.front().name, "blunt_notch");
  EXPECT_NEAR(diagnosis.effects.front().parameter, 0.012, 0.003);
  EXPECT_EQ(diagnosis.simulations, 0) << "none by itself";

  own.fractures->unaffordable = {"blunt_notch"};
  const Diagnosis without = diagnose(specimens, own);
  EXPECT_NE(without.verdict, Verdict::base_sufficient) << "it still acts";
  for (const NamedEffect& named : without.effects) EXPECT_NE(named.name, "blunt_notch");
  const auto candidate = std::ranges::find(without.candidates, "blunt_notch", &CandidateEffect::name);
  ASSERT_NE(candidate, without.candidates.end());
  EXPECT_EQ(candidate->status, CandidateStatus::not_simulated);
}

// The testers themselves: a second set of the same layouts costs nothing, and is diagnosed by the same models.
TEST(KeptEmulator, DoesNotFollowWhatWasMeasuredAndIsSimulatedOnce) {
  const auto set_of = [](double toughness_pa) {
    std::vector<measurement::SpecimenRecord> specimens(2);
    for (std::size_t i = 0; i < specimens.size(); ++i) {
      specimens[i].specimen = std::to_string(i);
      specimens[i].design = pattern::Pattern((std::uint64_t{1} << 55) - 1 - i);  // rigid: parts soon
      specimens[i].test = tester::TestKind::toughness;
      specimens[i].curve = curve_of(specimens[i].design, material::default_parameters(), 0.0);
      specimens[i].toughness_pa = toughness_pa;
    }
    return specimens;
  };
  DiagnosisSettings own = settings_for_plans();
  own.procedure.emulator.kept_pairs = 1;
  own.procedure.emulator.refined_specimens = 1;
  own.store = std::filesystem::temp_directory_path() / "nacre-kept-emulator-test.store";
  std::filesystem::remove(own.store);
  const auto first = kept_emulator(set_of(1e5), own), second = kept_emulator(set_of(2e5), own);
  ASSERT_TRUE(first && second);
  EXPECT_GT(first->simulations, 0);
  EXPECT_EQ(second->simulations, 0);
  ASSERT_EQ(first->runs.size(), second->runs.size());
  for (std::size_t k = 0; k < first->runs.size(); ++k) {
    EXPECT_EQ(first->runs[k].parameters, second->runs[k].parameters);
    EXPECT_EQ(first->runs[k].predictions.back().toughness_pa, second->runs[k].predictions.back().toughness_pa);
  }
  EXPECT_EQ(first->refined.size(), 2u);
  EXPECT_FALSE(kept_emulator({}, own)) << "nothing is broken";
  std::filesystem::remove(own.store);
}

}  // namespace
}  // namespace nacre::diagnosis
