#include "simulator_farm/simulate_work.hpp"

#include <optional>
#include <stdexcept>
#include <vector>

#include "base/result.hpp"
#include "crack/crack_record.hpp"
#include "film/film_file.hpp"
#include "simulator_farm/farm_core.hpp"
#include "simulator_farm/question.hpp"
#include "tester/tester.hpp"
#include "wire/convert.hpp"

namespace nacre::simulator_farm {
namespace {

store::CachedSimulation cached(const tester::ToughnessResult& result) {
  store::CachedSimulation answer;
  answer.toughness_pa = result.toughness_pa;
  answer.peak_stress_pa = result.peak_stress_pa;
  answer.failure_strain = result.failure_strain;
  answer.curve = tester::resampled(result.curve, kCurvePoints);
  return answer;
}

template <class Tested>
store::CachedSimulation failed(const Result<Tested>& result) {
  store::CachedSimulation answer;
  answer.failure = result.error().message;
  return answer;
}

/// Simulates and keeps what is asked for and not there yet.
void simulate(store::SimulationCache& cache, const std::string& key, const tester::Simulation& simulation,
              tester::TestKind test, const Extras& extras) {
  const std::optional<store::CachedSimulation> known = cache.find(key);
  if (test == tester::TestKind::modulus) {
    if (known) return;
    const auto result = tester::test_modulus(simulation);
    store::CachedSimulation answer;
    if (result) answer.modulus_pa = result->modulus_pa;
    return cache.insert(key, result ? answer : failed(result));
  }
  if (known && (!known->failure.empty() || !extras.fracture() || cache.find_breaks(key))) return;
  const auto result = tester::test_toughness(simulation);
  cache.insert(key, result ? cached(*result) : failed(result));
  if (result && extras.fracture()) cache.insert_breaks(key, result->breaks);
}

/// Makes the film of a specimen whose answer is known, unless it is there. Gives the file's name.
std::string filmed(const std::filesystem::path& folder, const std::string& key, const tester::Simulation& simulation,
                   const store::CachedSimulation& answer, const std::vector<tester::Break>& breaks) {
  const std::string name = key + ".film";
  if (std::filesystem::exists(folder / name)) return name;
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem) throw InputError::format("{}: cannot be made: {}", folder.string(), problem.message());
  tester::ToughnessResult known;
  known.failure_strain = answer.failure_strain;
  known.curve = answer.curve;
  known.breaks = breaks;
  const Result<film::Film> film = film::record_film(simulation, known);
  if (!film) throw std::logic_error("a specimen broke and cannot be filmed: " + film.error().message);
  film::write_film(folder / name, *film);
  return name;
}

wire::Fracture fracture_of(const tester::Simulation& simulation, std::vector<tester::Break> breaks) {
  wire::Fracture fracture;
  fracture.design = simulation.design;
  fracture.broken = static_cast<int>(breaks.size());
  fracture.crack = crack::record_of(simulation, std::move(breaks));
  return fracture;
}

std::string work(store::SimulationCache& cache, const std::filesystem::path& films, const std::string& spec) {
  const auto question = wire::read<wire::SimulateRequest>(spec);
  if (!question || question->designs.size() != 1 || tests_of(*question).size() != 1) {
    throw std::logic_error("the spec of a simulation is not one question: " +
                           (question ? spec : question.error().message));
  }
  const pattern::Design& design = question->designs.front();
  const tester::TestKind test = tests_of(*question).front();
  const tester::Simulation simulation = simulation_of(*question, design);
  const std::string key = tester::simulation_key(simulation, test);
  const Extras extras = wanted_extras(*question, test);
  simulate(cache, key, simulation, test, extras);
  // Out of the cache even when just simulated: curves are stored as floats, and an answer must not depend on who asked
  // first.
  store::CachedSimulation known = cache.find(key).value();
  Answer answer;
  if (known.failure.empty() && extras.fracture()) {
    const std::vector<tester::Break> breaks = cache.find_breaks(key).value();
    answer.fracture = fracture_of(simulation, breaks);
    if (extras.film) answer.fracture->film = filmed(films, key, simulation, known, breaks);
  }
  answer.design = {.design = design,
                   .failure = std::move(known.failure),
                   .modulus_pa = known.modulus_pa,
                   .toughness_pa = known.toughness_pa,
                   .peak_stress_pa = known.peak_stress_pa,
                   .failure_strain = known.failure_strain,
                   .curve = {}};
  if (extras.curve) answer.design.curve = std::move(known.curve);
  return write_answer(answer);
}

}  // namespace

std::map<std::string, runtime::WorkFunction> work_functions(std::shared_ptr<store::SimulationCache> cache,
                                                            std::filesystem::path films) {
  return {{"simulate", [cache = std::move(cache), films = std::move(films)](const std::string& spec) {
             return work(*cache, films, spec);
           }}};
}

}  // namespace nacre::simulator_farm
