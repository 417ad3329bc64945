#include "offline/simulate.hpp"

#include "base/parallel.hpp"
#include "base/processor_time.hpp"
#include "base/result.hpp"
#include "pattern/constraints.hpp"
#include "tester/refinement.hpp"

namespace nacre::offline {
namespace {

/// A test of a design; the number of its specimen counts in a toughness test alone.
struct SpecimenTest {
  SimulatedDesign* simulated;
  tester::TestKind test;
  int specimen = 0;
};

/// The long tests first.
std::vector<SpecimenTest> wanted_tests(std::vector<SimulatedDesign>& designs, const SimulateSettings& settings) {
  std::vector<SpecimenTest> tests;
  if (settings.toughness) {
    for (SimulatedDesign& simulated : designs) {
      const auto count = static_cast<std::size_t>(settings.specimens());
      simulated.pulled.assign(count, fail("not tested"));
      simulated.kernel_s.assign(count, 0.0);
      for (int i = 0; i < settings.specimens(); ++i) tests.push_back({&simulated, tester::TestKind::toughness, i});
    }
  }
  if (settings.modulus)
    for (SimulatedDesign& simulated : designs) tests.push_back({&simulated, tester::TestKind::modulus});
  return tests;
}

void pull_specimen(SimulatedDesign& simulated, tester::Simulation simulation, int specimen, int refinement) {
  const auto index = static_cast<std::size_t>(specimen);
  const double begun_s = processor_time_s();
  simulation.specimen = specimen;
  simulated.pulled[index] = tester::test_toughness(simulation, {.refinement = refinement});
  simulated.kernel_s[index] = processor_time_s() - begun_s;
}

/// What the broken specimens tell together, and the crack of the first; a refined crack counts other elements.
void sum_up(SimulatedDesign& simulated, const SimulateSettings& settings) {
  std::vector<tester::ToughnessResult> broken;
  for (const Result<tester::ToughnessResult>& each : simulated.pulled)
    if (each) broken.push_back(*each);
  if (broken.empty() || broken.size() < simulated.pulled.size()) return;
  simulated.toughness = tester::expected_toughness_of(std::move(broken));
  if (settings.choice.refine > 1) return;
  const tester::Simulation simulation = simulation_of(simulated.design, settings);
  simulated.crack = crack::record_of(simulation, simulated.pulled.front()->breaks);
  simulated.mechanisms = crack::mechanisms_of(simulation, *simulated.crack);
}

}  // namespace

material::ParameterSet chosen_model(const material::ParameterReader& read, const ModelChoice& choice,
                                    const std::array<std::string_view, 2>& names) {
  material::FailureCriterion criterion = material::base_criterion();
  if (choice.criterion) {
    const auto kind = material::criterion_from_string(*choice.criterion);
    if (!kind) throw InputError::format("{} {}: {}", names[0], *choice.criterion, kind.error().message);
    criterion.kind = *kind;
  }
  material::ParameterSet model = read(material::default_parameters(criterion));
  if (choice.criterion) model.criterion.kind = criterion.kind;
  if (choice.strength_cv) model.strength_cv = *choice.strength_cv;
  if (!material::is_strength_cv(model.strength_cv))
    throw InputError::format("{} {}: expected 0 or {} to {}", names[1], model.strength_cv,
                             material::kSmallestStrengthCv, material::kLargestStrengthCv);
  return model;
}

tester::Simulation simulation_of(const pattern::Design& design, const SimulateSettings& settings) {
  return {.design = design,
          .parameters = tester::refined(settings.parameters, settings.choice.refine),
          .conditions = {},
          .fidelity = settings.fidelity};
}

void run_tests(std::vector<SimulatedDesign>& designs, const SimulateSettings& settings,
               const std::function<void()>& done) {
  const std::vector<SpecimenTest> tests = wanted_tests(designs, settings);
  parallel_for(tests.size(), [&](int i) {
    const SpecimenTest& each = tests[static_cast<std::size_t>(i)];
    const tester::Simulation simulation = simulation_of(each.simulated->design, settings);
    if (each.test == tester::TestKind::modulus)
      each.simulated->modulus = tester::test_modulus(simulation, {.refinement = settings.choice.refine});
    else
      pull_specimen(*each.simulated, simulation, each.specimen, settings.choice.refine);
    if (done) done();
  });
  parallel_for(designs.size(), [&](int i) { sum_up(designs[static_cast<std::size_t>(i)], settings); });
}

std::string departure_from_proposals(const pattern::Design& design) {
  const pattern::Layout* layout = design.layout();
  if (layout == nullptr) return "";
  const auto symmetric = pattern::Pattern::from_layout(*layout);
  if (!symmetric) return "it lacks the eightfold symmetry of nacre's proposals";
  const auto violation = pattern::violation(*symmetric);
  return violation ? std::string(*violation) : "";
}

}  // namespace nacre::offline
