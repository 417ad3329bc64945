#include "simulator_farm/simulate_work.hpp"

#include <optional>
#include <stdexcept>
#include <vector>

#include <fmt/core.h>

#include "base/result.hpp"
#include "crack/crack_record.hpp"
#include "film/film_file.hpp"
#include "simulator_farm/batch_file.hpp"
#include "simulator_farm/farm_core.hpp"
#include "simulator_farm/question.hpp"
#include "store/kept_simulation.hpp"
#include "tester/tester.hpp"
#include "wire/convert.hpp"

namespace nacre::simulator_farm {
namespace {

/// Whether the cache holds all that is asked for beside the film.
bool has_numbers(const store::SimulationCache& cache, const std::optional<store::CachedSimulation>& known,
                 const AskedSimulation& asked) {
  if (!known) return false;
  return !known->failure.empty() || !asked.extras.fracture() || cache.find_breaks(asked.key).has_value();
}

/// Simulates and keeps what is asked for and not there yet.
void simulate(store::SimulationCache& cache, const AskedSimulation& asked) {
  const auto known = cache.find(asked.key);
  if (has_numbers(cache, known, asked)) return;
  const auto keep = [&](const store::CachedSimulation& answer) {
    if (cache.insert(asked.key, answer) || known) return;
    // Another farm with the same cache was faster; harmless, and worth knowing.
    fmt::print(stderr, "simulation {} was done twice at the same time\n", asked.key);
  };
  if (asked.test == tester::TestKind::modulus) return keep(store::kept(tester::test_modulus(asked.simulation)));
  const auto result = tester::test_toughness(asked.simulation);
  keep(store::kept(result));
  if (result && asked.extras.fracture()) cache.insert_breaks(asked.key, result->breaks);
}

std::string film_name(const std::string& key) { return key + ".film"; }

/// Makes the film of a specimen whose answer is known, unless it is there. Gives the file's name.
std::string filmed(const std::filesystem::path& folder, const std::string& key, const tester::Simulation& simulation,
                   const store::CachedSimulation& answer, const std::vector<tester::Break>& breaks) {
  const std::string name = film_name(key);
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
  // Under a name of this process' own first: two tasks of a cluster may be making the same film.
  const std::filesystem::path aside = folder / (name + "." + own_name());
  film::write_film(aside, *film);
  std::filesystem::rename(aside, folder / name);
  return name;
}

wire::Fracture fracture_of(const tester::Simulation& simulation, std::vector<tester::Break> breaks) {
  wire::Fracture fracture;
  fracture.design = simulation.design;
  fracture.broken = static_cast<int>(breaks.size());
  fracture.crack = crack::record_of(simulation, std::move(breaks));
  return fracture;
}

}  // namespace

AskedSimulation asked_in(const std::string& spec) {
  const auto question = wire::read<wire::SimulateRequest>(spec);
  if (!question || question->designs.size() != 1 || tests_of(*question).size() != 1) {
    throw std::logic_error("the spec of a simulation is not one question: " +
                           (question ? spec : question.error().message));
  }
  AskedSimulation asked;
  asked.test = tests_of(*question).front();
  asked.simulation = simulation_of(*question, question->designs.front());
  asked.key = tester::simulation_key(asked.simulation, asked.test);
  asked.extras = wanted_extras(*question, asked.test);
  return asked;
}

bool is_known(const store::SimulationCache& cache, const std::filesystem::path& films, const AskedSimulation& asked) {
  const auto known = cache.find(asked.key);
  if (!has_numbers(cache, known, asked)) return false;
  return !known->failure.empty() || !asked.extras.film || std::filesystem::exists(films / film_name(asked.key));
}

std::string simulate_work(store::SimulationCache& cache, const std::filesystem::path& films, const std::string& spec) {
  const AskedSimulation asked = asked_in(spec);
  simulate(cache, asked);
  // Out of the cache even when just simulated: curves are stored as floats, and an answer must not depend on who asked
  // first.
  store::CachedSimulation known = cache.find(asked.key).value();
  Answer answer;
  if (known.failure.empty() && asked.extras.fracture()) {
    const std::vector<tester::Break> breaks = cache.find_breaks(asked.key).value();
    answer.fracture = fracture_of(asked.simulation, breaks);
    if (asked.extras.film) answer.fracture->film = filmed(films, asked.key, asked.simulation, known, breaks);
  }
  answer.design = {.design = asked.simulation.design,
                   .failure = std::move(known.failure),
                   .modulus_pa = known.modulus_pa,
                   .toughness_pa = known.toughness_pa,
                   .peak_stress_pa = known.peak_stress_pa,
                   .failure_strain = known.failure_strain,
                   .curve = {}};
  if (asked.extras.curve) answer.design.curve = std::move(known.curve);
  return write_answer(answer);
}

std::map<std::string, runtime::WorkFunction> work_functions(std::shared_ptr<store::SimulationCache> cache,
                                                            std::filesystem::path films) {
  return {{"simulate", [cache = std::move(cache), films = std::move(films)](const std::string& spec) {
             return simulate_work(*cache, films, spec);
           }}};
}

}  // namespace nacre::simulator_farm
