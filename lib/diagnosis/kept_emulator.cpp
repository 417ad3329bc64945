#include "diagnosis/kept_emulator.hpp"

#include <algorithm>
#include <iterator>

#include "base/random.hpp"
#include "diagnosis/fracture_tests.hpp"
#include "diagnosis/planned_runs.hpp"

namespace nacre::diagnosis {
namespace {

std::vector<material::ParameterSet> kept_models(const material::ParameterSet& centre, const Procedure& procedure) {
  EmulatorRules rules = procedure.emulator;
  rules.spread = rules.kept_spread;
  rules.jitter = rules.kept_jitter;
  RandomStream random(1, "diagnosis/kept emulator");
  std::vector<material::ParameterSet> models = {centre};
  std::ranges::move(opposite_pairs(centre, rules.kept_pairs, rules, random), std::back_inserter(models));
  for (const material::Effect* effect : fracture_effects())
    for (const double sign : {1.0, -1.0})
      for (const double size : rules.kept_sizes)
        if (auto set = with_effect(centre, *effect, sign * size, procedure.constants, rules, random))
          models.push_back(std::move(*set));
  return models;
}

material::ParameterSet base_of(material::ParameterSet set) {
  set.extensions.clear();
  return set;
}

Observations observed(const std::vector<measurement::SpecimenRecord>& specimens, const DiagnosisSettings& settings) {
  return observe(specimens, settings.floor.log_modulus_sd, settings.fracture_discretisation, settings.procedure);
}

std::vector<RefinedLayout> refined(const FractureTests& tests, const DiagnosisSettings& settings) {
  material::ParameterSet at = base_of(settings.start);
  if (settings.fractures) at.toughness = settings.fractures->centre.value_or(at.toughness);
  return tests.refined_layouts(at, settings.procedure.curves, settings.procedure.emulator);
}

}  // namespace

std::optional<SimulatedFractures> kept_emulator(const std::vector<measurement::SpecimenRecord>& specimens,
                                                const DiagnosisSettings& settings) {
  const Observations observations = observed(specimens, settings);
  if (!observations.has(tester::TestKind::toughness)) return std::nullopt;
  const FractureTests tests(observations, settings.fidelity, settings.store, settings.threads);
  const std::vector<material::ParameterSet> models = kept_models(base_of(settings.start), settings.procedure);
  const double all = static_cast<double>(models.size() * tests.groups().size());
  int done = 0;
  const auto report = [&] {
    ++done;
    if (settings.progress)
      settings.progress(std::min(1.0, done / all),
                        fmt::format("fracture tests of the kept emulator: {} of {:.0f}", done, all));
  };
  SimulatedFractures kept{.runs = tests.runs_at(models, {}, report), .unaffordable = {}};
  kept.refined = refined(tests, settings);
  kept.simulations = tests.simulations();
  return kept;
}

std::vector<RefinedLayout> refined_layouts_of(const std::vector<measurement::SpecimenRecord>& specimens,
                                              const DiagnosisSettings& settings) {
  return refined(FractureTests(observed(specimens, settings), settings.fidelity, settings.store, settings.threads),
                 settings);
}

}  // namespace nacre::diagnosis
