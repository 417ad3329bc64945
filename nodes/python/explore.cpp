// Part of the Python module (module.hpp): explore, the search of the gamut.

#include "offline/explore.hpp"

#include "background.hpp"
#include "base/output_path.hpp"
#include "conversion.hpp"
#include "explore/gamut_csv.hpp"
#include "gamuts.hpp"
#include "module.hpp"
#include "parameters.hpp"

namespace nacre::python {
namespace {

namespace py = pybind11;

/// Adds known and former samples. Throws InputError for what the command line refuses.
void add_samples(explore::SearchSettings& search, const std::string& known, const std::string& former) {
  if (!known.empty()) search.known = explore::read_gamut_csv(known);
  if (former.empty()) return;
  search.former = explore::read_gamut_csv(former);
  if (search.former.empty()) throw InputError::format("{}: holds no samples, expected some to learn from", former);
}

py::dict explore_gamut(const py::object& params, const std::string& algorithm, int budget, const std::string& fidelity,
                       std::int64_t seed, int population, int batch, int specimens, const py::object& out,
                       const py::object& cache, const py::object& known, const py::object& former,
                       const py::object& progress) {
  require_range("budget", budget, 1, 10'000'000);
  require_range("population", population, 2, 100'000);
  require_range("batch", batch, 1, 100'000);
  require_range("specimens", specimens, 1, 100);
  offline::ExploreSettings settings;
  settings.parameters = parameters_from(params, material::default_parameters());
  settings.fidelity = fidelity_from(fidelity);
  settings.search.algorithm = algorithm;
  settings.search.budget = budget;
  settings.search.population = population;
  settings.search.batch = batch;
  settings.search.seed = seed_from(seed);
  settings.search.learned.specimens = specimens;
  add_samples(settings.search, path_from(known, "known"), path_from(former, "former"));
  if (const std::string fault = offline::search_fault(settings); !fault.empty()) throw InputError(fault);
  settings.cache = path_from(cache, "cache");
  const std::string file = path_from(out, "out");
  if (!file.empty()) prepare_output_file(file, {settings.cache.string(), path_from(former, "former")});
  if (!settings.cache.empty() && !file.empty()) settings.batches = file + ".batches";
  const offline::Explored explored = in_background(progress, [&](Watch& watch) {
    return offline::explore_gamut(settings,
                                  {.simulated = [&] { watch.count(budget, "simulating"); }, .stopped = {}, .told = {}});
  });
  if (!file.empty()) explore::write_gamut_csv(file, explored.gamut);
  py::dict result = python_of(to_json(explored, file));
  add_gamut(result, explored.gamut);
  return result;
}

constexpr const char* kExplore = R"(Searches for patterns that are stiff and tough, by simulation.

params, fidelity, progress: as of simulate().
algorithm: "nsga2", "learned", "random" and others of `nacre explore --help`.
budget: patterns to simulate, 1 to 10,000,000; population: of a generation, or of the first batch, 2 to 100,000; batch:
    simulated between two steps of the search, 1 to 100,000.
seed: of every random choice, 0 to 2^63 - 1.
specimens: of a pattern that "learned" may test, 1 to 100; further ones where they decide: T is then an expectation.
out: gamut.csv to write; None: none. cache: database that keeps the simulations, so that an interrupted search goes on.
known: gamut.csv of the same parameters and fidelity, whose patterns are not simulated again.
former: gamut.csv of other parameters or another fidelity, from which "learned" learns.

Returns the fields of `nacre explore --json`: evaluated, failed, front (numbers of patterns), hypervolume_gpa_mpa, gamut
    (the file or None); then by order of evaluation pattern (keys), modulus_pa, toughness_pa, specimens,
    toughness_se_pa (0: unknown) and is_on_front.
Raises InputError for bad input, KeyboardInterrupt after Ctrl-C; the cache then holds what was simulated.)";

}  // namespace

void add_explore(py::module_& module) {
  module.def("explore", explore_gamut, py::kw_only(), py::arg("params") = py::none(), py::arg("algorithm") = "nsga2",
             py::arg("budget") = 300, py::arg("fidelity") = "full", py::arg("seed") = 1, py::arg("population") = 20,
             py::arg("batch") = 10, py::arg("specimens") = 1, py::arg("out") = py::none(),
             py::arg("cache") = py::none(), py::arg("known") = py::none(), py::arg("former") = py::none(),
             py::arg("progress") = py::none(), kExplore);
}

}  // namespace nacre::python
