#include "tester/elastic_key.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "material/extensions.hpp"
#include "pattern/design.hpp"
#include "tester/assembly.hpp"
#include "tester/modulus.hpp"
#include "tester/modulus_probe.hpp"

namespace nacre::tester {
namespace {

Simulation layout_with(const material::Extensions& extensions = {}) {
  Simulation simulation{
      *pattern::design_from_name("577fffe9fffdef"), material::thesis_parameters(), {}, Fidelity::tiny};
  simulation.parameters.extensions = extensions;
  return simulation;
}

/// Turned, ten times as fast and half as thick.
Simulation conditions_twin_of(Simulation simulation) {
  simulation.conditions.orientation_deg = 90.0;
  simulation.conditions.strain_rate_per_s *= 10.0;
  simulation.conditions.thickness_mm *= 0.5;
  return simulation;
}

/// An effect well inside its range.
material::Extensions with_effect(const material::Effect& effect) {
  std::vector<double> values;
  for (const material::EffectParameter& parameter : effect.parameters)
    values.push_back(material::value_at_strength(parameter, 0.3));
  return {{std::string(effect.name), values}};
}

bool have_equal_elements(const Simulation& a, const Simulation& b) {
  const UnitOfModulus first = unit_of_modulus(*a.design.layout(), a.parameters, a.conditions, 1),
                      second = unit_of_modulus(*b.design.layout(), b.parameters, b.conditions, 1);
  const auto same = [](const material::Constants& x, const material::Constants& y) {
    return x.young_pa == y.young_pa && x.poisson == y.poisson;
  };
  return first.kind_of == second.kind_of && std::ranges::equal(first.kinds, second.kinds, same);
}

// Whatever effect is added to the library: where keys are the same, so are the elements.
TEST(ElasticKey, IsTheSameOnlyWhereTheElementsAre) {
  int same = 0, other = 0;
  for (const material::Effect& effect : material::effect_library()) {
    const Simulation own = layout_with(with_effect(effect)), twin = conditions_twin_of(own), plain = layout_with();
    for (const auto& [a, b] : {std::pair(own, twin), std::pair(own, plain)}) {
      const bool equal_keys = elastic_key(a) == elastic_key(b);
      ++(equal_keys ? same : other);
      if (equal_keys) EXPECT_TRUE(have_equal_elements(a, b)) << effect.name;
    }
  }
  EXPECT_GT(same, 10);
  EXPECT_GT(other, 5);
}

TEST(ElasticKey, TwinsOfTheBaseModelHaveOne) {
  EXPECT_EQ(elastic_key(layout_with()), elastic_key(conditions_twin_of(layout_with())));
  EXPECT_NE(elastic_key(layout_with()), elastic_key(layout_with(), 2));
  const Simulation anisotropic = layout_with({{"interface_anisotropy", {0.3}}});
  EXPECT_NE(elastic_key(anisotropic), elastic_key(conditions_twin_of(anisotropic)));
}

TEST(ElasticKey, OneSolutionServesEveryRateOfMaterialsThatRelaxAlike) {
  const Simulation slow = layout_with({{"rate_dependence", {0.5, 1.0}}}), fast = conditions_twin_of(slow);
  ASSERT_EQ(elastic_key(slow), elastic_key(fast));
  const auto solved = ModulusProbe::at(slow);
  ASSERT_TRUE(solved);
  const double expected = test_modulus(fast).value().modulus_pa;
  EXPECT_EQ(solved->of(fast).modulus_pa(), expected);
  EXPECT_GT(expected, 1.01 * solved->modulus_pa());
  // The slopes are those of the other simulation too.
  material::ParameterSet other = fast.parameters;
  other.extensions["rate_dependence"] = {0.55, 1.0};
  EXPECT_DOUBLE_EQ(solved->of(fast).nearby(other), ModulusProbe::at(fast)->nearby(other));
}

}  // namespace
}  // namespace nacre::tester
