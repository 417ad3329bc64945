#include "simulator_farm/simulate_work.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <vector>

#include <fmt/core.h>

#include "base/files.hpp"
#include "base/result.hpp"
#include "crack/crack_record.hpp"
#include "film/film_file.hpp"
#include "simulator_farm/farm_core.hpp"
#include "simulator_farm/test_request.hpp"
#include "store/kept_simulation.hpp"
#include "tester/simulation_key.hpp"
#include "wire/convert.hpp"

namespace nacre::simulator_farm {
namespace {

/// Two computations that round otherwise tell of one fracture when toughness, peak stress and failure strain differ by
/// no more than this share. Chosen here; up to the first failure they differ by less than 0.1 % (docs/studies/gpu.md).
constexpr double kLargestDifference = 0.01;
/// A film is that of a crack when this share of the elements that failed is the same: the mirror image, which rounding
/// may choose as well, has the same numbers.
constexpr double kLeastInCommon = 0.9;

constexpr const char* kNoCrack =
    "its crack cannot be told: its numbers were computed elsewhere (by a device), and computed here the specimen "
    "breaks otherwise";

bool are_close(double a, double b) { return std::abs(a - b) <= kLargestDifference * std::abs(b); }

/// Whether two results of one test tell of one fracture, but for rounding.
bool are_of_one_fracture(const store::CachedSimulation& a, const store::CachedSimulation& b) {
  return a.failure.empty() && b.failure.empty() && are_close(a.toughness_pa, b.toughness_pa) &&
         are_close(a.peak_stress_pa, b.peak_stress_pa) && are_close(a.failure_strain, b.failure_strain);
}

/// Whether most of the elements that failed are the same, in whatever order.
bool have_most_in_common(const std::vector<tester::Break>& a, const std::vector<tester::Break>& b) {
  const auto elements_of = [](const std::vector<tester::Break>& breaks) {
    std::vector<int> elements;
    for (const tester::Break& broken : breaks) elements.push_back(broken.element);
    std::sort(elements.begin(), elements.end());
    return elements;
  };
  const std::vector<int> of_a = elements_of(a), of_b = elements_of(b);
  std::vector<int> common;
  std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(common));
  return static_cast<double>(common.size()) >= kLeastInCommon * static_cast<double>(std::max(a.size(), b.size()));
}

bool has_numbers(const store::SimulationCache& cache, const std::optional<store::CachedSimulation>& known,
                 const AskedSimulation& asked) {
  if (!known) return false;
  return !known->failure.empty() || !asked.extras.fracture() || cache.find_breaks(asked.key).has_value();
}

/// Simulates and keeps what is asked for and not there yet.
void simulate(store::SimulationCache& cache, const AskedSimulation& asked) {
  const auto known = cache.find(asked.key);
  if (has_numbers(cache, known, asked)) return;
  const auto keep = [&](const store::CachedSimulation& response, const std::vector<tester::Break>* breaks) {
    if (keep_response(cache, asked.key, response, breaks) || known) return;
    // Another farm with the same cache was faster; harmless, and worth knowing.
    fmt::print(stderr, "simulation {} was done twice at the same time\n", asked.key);
  };
  if (asked.test == tester::TestKind::modulus)
    return keep(store::kept(tester::test_modulus(asked.simulation)), nullptr);
  const auto result = tester::test_toughness(asked.simulation);
  keep(store::kept(result), result && asked.extras.fracture() ? &result->breaks : nullptr);
}

std::string film_name(const std::string& key) { return key + ".film"; }

/// Whether a film, for which the specimen is pulled once more here, shows the fracture of the response.
bool shows(const film::Film& film, const store::CachedSimulation& response, const std::vector<tester::Break>& breaks) {
  store::CachedSimulation pulled;
  pulled.toughness_pa = film.toughness_pa;
  pulled.peak_stress_pa = film.peak_stress_pa;
  pulled.failure_strain = film.failure_strain;
  return are_of_one_fracture(pulled, response) && have_most_in_common(film.crack.order, breaks);
}

/// Makes the film of a specimen whose result is known, unless it is there. Gives the file's name; empty, and a line for
/// the log, where there can be none.
std::string filmed(const std::filesystem::path& folder, const std::string& key, const tester::Simulation& simulation,
                   const store::CachedSimulation& response, const std::vector<tester::Break>& breaks) {
  const std::string name = film_name(key);
  if (std::filesystem::exists(folder / name)) return name;
  tester::ToughnessResult known;
  known.failure_strain = response.failure_strain;
  known.curve = response.curve;
  known.breaks = breaks;
  const Result<film::Film> film = film::record_film(simulation, known);
  if (!film || !shows(*film, response, breaks)) {
    fmt::print(stderr, "no film of {}, {}: {}\n", simulation.design.name(), key,
               film ? "its numbers were computed elsewhere (by a device), and pulled here the specimen breaks otherwise"
                    : film.error().message);
    return {};
  }
  make_folder(folder);
  film::write_film(folder / name, *film);
  return name;
}

wire::Fracture fracture_of(const tester::Simulation& simulation, std::vector<tester::Break> breaks) {
  wire::Fracture fracture;
  fracture.design = simulation.design;
  fracture.broken = breaks.size();
  fracture.crack = crack::record_of(simulation, std::move(breaks));
  return fracture;
}

}  // namespace

AskedSimulation asked_in(const std::string& spec) {
  const auto test_request = wire::read<wire::SimulateRequest>(spec);
  if (!test_request || test_request->designs.size() != 1 || tests_of(*test_request).size() != 1) {
    throw std::logic_error("the spec of a simulation is not one test request: " +
                           (test_request ? spec : test_request.error().message));
  }
  AskedSimulation asked;
  const WantedTest wanted = tests_of(*test_request).front();
  asked.test = wanted.test;
  asked.simulation = simulation_of(*test_request, test_request->designs.front(), wanted.specimen);
  asked.key = tester::simulation_key(asked.simulation, asked.test);
  asked.extras = wanted.extras;
  return asked;
}

bool has_numbers(const store::SimulationCache& cache, const AskedSimulation& asked) {
  return has_numbers(cache, cache.find(asked.key), asked);
}

bool is_known(const store::SimulationCache& cache, const std::filesystem::path& films, const AskedSimulation& asked) {
  const auto known = cache.find(asked.key);
  if (!has_numbers(cache, known, asked)) return false;
  return !known->failure.empty() || !asked.extras.film || std::filesystem::exists(films / film_name(asked.key));
}

bool keep_response(store::SimulationCache& cache, const std::string& key, const store::CachedSimulation& response,
                   const std::vector<tester::Break>* breaks) {
  const bool is_new = cache.insert(key, response);
  if (breaks && (is_new || are_of_one_fracture(response, cache.find(key).value()))) cache.insert_breaks(key, *breaks);
  return is_new;
}

std::string simulate_work(store::SimulationCache& cache, const std::filesystem::path& films, const std::string& spec) {
  const AskedSimulation asked = asked_in(spec);
  simulate(cache, asked);
  // Out of the cache even when just simulated: curves are stored as floats, and a response must not depend on who
  // requested first.
  store::CachedSimulation known = cache.find(asked.key).value();
  TestResponse response;
  if (known.failure.empty() && asked.extras.fracture()) {
    if (const auto breaks = cache.find_breaks(asked.key)) {
      response.fracture = fracture_of(asked.simulation, *breaks);
      if (asked.extras.film) response.fracture->film = filmed(films, asked.key, asked.simulation, known, *breaks);
    } else {
      known = {};
      known.failure = kNoCrack;
    }
  }
  response.design = {.design = asked.simulation.design,
                     .failure = std::move(known.failure),
                     .modulus_pa = known.modulus_pa,
                     .toughness_pa = known.toughness_pa,
                     .toughness_sd_pa = 0.0,
                     .specimens = asked.test == tester::TestKind::toughness ? 1 : 0,
                     .peak_stress_pa = known.peak_stress_pa,
                     .failure_strain = known.failure_strain,
                     .curve = {}};
  if (asked.extras.curve) response.design.curve = std::move(known.curve);
  return write_response(response);
}

std::map<std::string, runtime::WorkFunction> work_functions(std::shared_ptr<store::SimulationCache> cache,
                                                            std::filesystem::path films) {
  return {{"simulate", [cache = std::move(cache), films = std::move(films)](const std::string& spec) {
             return simulate_work(*cache, films, spec);
           }}};
}

}  // namespace nacre::simulator_farm
