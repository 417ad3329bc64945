#include "simulator_farm/simulate_work.hpp"

#include <stdexcept>

#include "simulator_farm/farm_core.hpp"
#include "simulator_farm/question.hpp"
#include "tester/tester.hpp"
#include "wire/convert.hpp"

namespace nacre::simulator_farm {
namespace {

store::CachedSimulation simulate(const tester::Simulation& simulation, tester::TestKind test) {
  store::CachedSimulation answer;
  if (test == tester::TestKind::modulus) {
    const auto result = tester::test_modulus(simulation);
    if (result) {
      answer.modulus_pa = result->modulus_pa;
    } else {
      answer.failure = result.error().message;
    }
    return answer;
  }
  const auto result = tester::test_toughness(simulation);
  if (!result) {
    answer.failure = result.error().message;
    return answer;
  }
  answer.toughness_pa = result->toughness_pa;
  answer.peak_stress_pa = result->peak_stress_pa;
  answer.failure_strain = result->failure_strain;
  answer.curve = tester::resampled(result->curve, kCurvePoints);
  return answer;
}

std::string work(store::SimulationCache& cache, const std::string& spec) {
  const auto question = wire::read<wire::SimulateRequest>(spec);
  if (!question || question->designs.size() != 1 || tests_of(*question).size() != 1) {
    throw std::logic_error("the spec of a simulation is not one question: " +
                           (question ? spec : question.error().message));
  }
  const pattern::Design& design = question->designs.front();
  const tester::TestKind test = tests_of(*question).front();
  const tester::Simulation simulation = simulation_of(*question, design);
  const std::string key = tester::simulation_key(simulation, test);
  if (!cache.find(key)) cache.insert(key, simulate(simulation, test));
  // Out of the cache even when just simulated: curves are stored as floats, and an answer must not depend on who asked
  // first.
  store::CachedSimulation answer = cache.find(key).value();
  wire::SimulatedDesign result;
  result.design = design;
  result.failure = std::move(answer.failure);
  result.modulus_pa = answer.modulus_pa;
  result.toughness_pa = answer.toughness_pa;
  result.peak_stress_pa = answer.peak_stress_pa;
  result.failure_strain = answer.failure_strain;
  if (question->curve_points > 0) result.curve = std::move(answer.curve);
  return wire::write(wire::SimulateResult{
      .request_id = question->request_id, .chunk = 0, .chunks = 1, .first = 0, .results = {std::move(result)}});
}

}  // namespace

std::map<std::string, runtime::WorkFunction> work_functions(std::shared_ptr<store::SimulationCache> cache) {
  return {{"simulate", [cache = std::move(cache)](const std::string& spec) { return work(*cache, spec); }}};
}

}  // namespace nacre::simulator_farm
