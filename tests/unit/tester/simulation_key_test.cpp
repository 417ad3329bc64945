#include <set>

#include <gtest/gtest.h>

#include "tester/simulation_key.hpp"

namespace nacre::tester {
namespace {

Simulation question() {
  return {.design = pattern::design_from_name("577fffe9fffdef").value(),
          .parameters = material::thesis_parameters(),
          .conditions = {},
          .fidelity = Fidelity::full};
}

/// Whether the change makes it another simulation.
template <class Change>
bool distinguishes(TestKind kind, Change change) {
  Simulation other = question();
  change(other);
  return simulation_key(other, kind) != simulation_key(question(), kind);
}

TEST(SimulationKey, IsTheSameForTheSameQuestion) {
  EXPECT_EQ(simulation_key(question(), TestKind::modulus), simulation_key(question(), TestKind::modulus));
  EXPECT_EQ(simulation_key(question(), TestKind::modulus).size(), 32u);
}

TEST(SimulationKey, TellsTestsApart) {
  std::set<std::string> keys;
  for (const TestKind kind : {TestKind::modulus, TestKind::toughness, TestKind::tensile})
    keys.insert(simulation_key(question(), kind));
  EXPECT_EQ(keys.size(), 3u);
}

TEST(SimulationKey, ChangesWithDesignFidelityAndOrientation) {
  for (const TestKind kind : {TestKind::modulus, TestKind::toughness}) {
    EXPECT_TRUE(
        distinguishes(kind, [](Simulation& s) { s.design = pattern::design_from_name("3ffc9b4ad4d2d9").value(); }));
    EXPECT_TRUE(distinguishes(kind, [](Simulation& s) { s.design = pattern::Mixture{0.65}; }));
    EXPECT_TRUE(distinguishes(kind, [](Simulation& s) { s.fidelity = Fidelity::preview; }));
    EXPECT_TRUE(distinguishes(kind, [](Simulation& s) { s.conditions.orientation_deg = 90.0; }));
  }
}

TEST(SimulationKey, OfTheToughnessChangesWithTheVariationOfStrength) {
  const auto varied = [](Simulation& s) { s.parameters.strength_cv = 0.1; };
  EXPECT_TRUE(distinguishes(TestKind::toughness, varied));
  EXPECT_FALSE(distinguishes(TestKind::modulus, varied));
  EXPECT_FALSE(distinguishes(TestKind::toughness, [](Simulation& s) { s.parameters.strength_cv = 0.0; }));
}

TEST(SimulationKey, TellsSpecimensApartThatDiffer) {
  const auto second = [](Simulation& s) { s.specimen = 1; };
  EXPECT_FALSE(distinguishes(TestKind::toughness, second)) << "all specimens are alike";
  Simulation one = question();
  one.parameters.strength_cv = 0.1;
  Simulation other = one;
  other.specimen = 1;
  EXPECT_NE(simulation_key(one, TestKind::toughness), simulation_key(other, TestKind::toughness));
  EXPECT_EQ(simulation_key(one, TestKind::modulus), simulation_key(other, TestKind::modulus));
}

// The keys of caches that there are: without a variation of strength none has changed.
TEST(SimulationKey, IsTheOneThatCachesHave) {
  EXPECT_EQ(kKernelVersion, 8) << "another kernel: other keys";
  EXPECT_EQ(simulation_key(question(), TestKind::toughness), "f3aee0f770090b67d89a31f6f3b68a74");
}

TEST(SimulationKey, OfTheModulusFeelsThetaAndNothingOfEta) {
  for (int i = 0; i < material::kModulusParameterCount; ++i) {
    const bool is_damping = material::modulus_parameter_names()[i] == "gamma_per_s";
    const auto change = [i](Simulation& s) {
      auto theta = material::to_vector(s.parameters.modulus);
      theta[i] *= 1.0 + 1e-15;
      s.parameters.modulus = material::modulus_from_vector(theta);
    };
    EXPECT_EQ(distinguishes(TestKind::modulus, change), !is_damping) << i;  // the static solution has no damping
    EXPECT_FALSE(distinguishes(TestKind::toughness, change));
  }
  EXPECT_FALSE(distinguishes(TestKind::modulus, [](Simulation& s) { s.conditions.strain_rate_per_s *= 2.0; }));
}

TEST(SimulationKey, OfTheToughnessFeelsEveryEta) {
  for (int i = 0; i < material::kToughnessParameterCount; ++i) {
    const auto change = [i](Simulation& s) {
      auto eta = material::to_vector(s.parameters.toughness);
      eta[i] *= 1.0 + 1e-15;
      s.parameters.toughness = material::toughness_from_vector(eta);
    };
    EXPECT_TRUE(distinguishes(TestKind::toughness, change)) << i;
    EXPECT_FALSE(distinguishes(TestKind::modulus, change)) << i;
  }
}

TEST(SimulationKey, FeelsExtensionsThatActAndNoOthers) {
  const auto with = [](std::string name, double value) {
    return [name = std::move(name), value](Simulation& s) { s.parameters.extensions[name] = {value}; };
  };
  for (const TestKind kind : {TestKind::modulus, TestKind::toughness}) {
    EXPECT_TRUE(distinguishes(kind, with("interface_anisotropy", 0.1)));
    EXPECT_FALSE(distinguishes(kind, with("interface_anisotropy", 0.0)));
    EXPECT_FALSE(distinguishes(kind, with("interface_anisotropy", -0.0)));
    EXPECT_FALSE(distinguishes(kind, with("machine_compliance", 1e-10)));  // the simulation does not see the machine
  }
}

}  // namespace
}  // namespace nacre::tester
