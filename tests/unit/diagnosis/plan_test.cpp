#include "diagnosis/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/workbench.hpp"
#include "material/extensions.hpp"
#include "synthetic_set.hpp"

namespace nacre::diagnosis {
namespace {

TEST(Plan, ACauseWithoutANameIsCountedLikeOneOfTheLibrary) {
  // The same change of the same specimens: as a signature of the library, and as what another set of values shows.
  DiagnosisSettings settings;
  settings.start = material::default_parameters();
  settings.fidelity = tester::Fidelity::tiny;
  const AssumedScatter scatter{.modulus = 0.01, .stress = 0.01, .strain = 0.01};
  const SyntheticSet set{.patterns = 10, .twins = 3, .noise = 0.0};
  const material::Effect& mixing = *material::find_effect("droplet_mixing");
  material::ParameterSet mixed = settings.start;
  mixed.extensions["droplet_mixing"] = {material::value_at_strength(mixing.parameters.front(), kSizes[kTypicalSize])};
  const auto plain = synthetic_specimens(set, settings.start), changed = synthetic_specimens(set, mixed);
  const Plan plan = plan_diagnosis(plain, settings, scatter, false);
  const auto planned = std::ranges::find(plan.effects, "droplet_mixing", &PlannedEffect::name);
  const double s = signal_of_change(plain, changed, settings, scatter);
  EXPECT_GT(s, 3.0);
  EXPECT_NEAR(s, planned->signal_to_noise, 1e-3 * s);
}

}  // namespace
}  // namespace nacre::diagnosis
