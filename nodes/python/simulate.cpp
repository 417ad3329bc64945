// Part of the Python module (module.hpp): simulate, the two testers on patterns.

#include "offline/simulate.hpp"

#include <pybind11/stl.h>

#include "background.hpp"
#include "base/parallel.hpp"
#include "conversion.hpp"
#include "films.hpp"
#include "material/extensions.hpp"
#include "module.hpp"
#include "parameters.hpp"
#include "tester/strength_field.hpp"

namespace nacre::python {
namespace {

namespace py = pybind11;
using offline::SimulatedDesign;
using offline::SimulateSettings;

struct SimulateArguments {
  std::string test, fidelity;
  std::optional<int> specimens;
  offline::ModelChoice model;
  int refine;
  int frame_count;  ///< 0: no films
};

SimulateSettings settings_from(const SimulateArguments& given, const py::object& params) {
  if (given.specimens) require_range("specimens", *given.specimens, 1, 1000);
  require_range("refine", given.refine, 1, 8);
  if (given.test != "modulus" && given.test != "toughness" && given.test != "both")
    throw InputError::format("test {}: expected modulus, toughness or both", given.test);
  if (given.frame_count != 0) require_range("film", given.frame_count, 2, 1000);
  if (given.frame_count != 0 && given.test == "modulus")
    throw InputError("film shows the toughness test: test modulus does not run it");
  if (given.frame_count != 0 && given.refine > 1) throw InputError("film shows unrefined elements: leave out refine");
  const auto read = [&](const material::ParameterSet& start) { return parameters_from(params, start); };
  return {.parameters = offline::chosen_model(read, given.model),
          .fidelity = fidelity_from(given.fidelity),
          .modulus = given.test != "toughness",
          .toughness = given.test != "modulus",
          .choice = {.count = given.specimens, .refine = given.refine}};
}

/// A design with its film, where one was asked for.
struct Tested {
  SimulatedDesign simulated;
  std::optional<Result<film::Film>> film;
};

std::vector<Tested> tested(std::vector<SimulatedDesign> designs, const SimulateSettings& settings, int frame_count,
                           Watch& watch) {
  const int films = frame_count > 0 ? static_cast<int>(designs.size()) : 0;
  const int all = static_cast<int>(designs.size()) * settings.tests_of_a_design() + films;
  offline::run_tests(designs, settings, [&] { watch.count(all, "testing"); });
  std::vector<Tested> results(designs.size());
  for (std::size_t i = 0; i < designs.size(); ++i) results[i].simulated = std::move(designs[i]);
  parallel_for(films, [&](int i) {
    Tested& each = results[static_cast<std::size_t>(i)];
    if (each.simulated.toughness)
      each.film = film::record_film(simulation_of(each.simulated.design, settings), *each.simulated.pulled.front(),
                                    frame_count);
    watch.count(all, "filming");
  });
  return results;
}

py::object entry_of(const Tested& each, const SimulateSettings& settings) {
  const py::dict entry = python_of(to_json(each.simulated, settings));
  if (entry.contains("error")) return entry;
  py::list curves;
  for (const Result<tester::ToughnessResult>& pulled : each.simulated.pulled) curves.append(python_of(pulled->curve));
  entry["curves"] = curves;
  if (each.film && !*each.film)
    throw InputError::format("{}: no film: {}", each.simulated.argument, each.film->error().message);
  if (each.film) entry["film"] = python_of(**each.film);
  return entry;
}

py::object simulate(const py::object& patterns, const py::object& params, const SimulateArguments& given,
                    const py::object& progress) {
  const NamedDesigns asked = designs_from(patterns);
  const SimulateSettings settings = settings_from(given, params);
  std::vector<SimulatedDesign> designs;
  for (const auto& [argument, design] : asked.designs) {
    designs.emplace_back().argument = argument;
    designs.back().design = design;
  }
  const std::vector<Tested> results = in_background(
      progress, [&](Watch& watch) { return tested(std::move(designs), settings, given.frame_count, watch); });
  py::list entries;
  for (const Tested& each : results) entries.append(entry_of(each, settings));
  if (!asked.is_single) return entries;
  if (const std::string failure = results.front().simulated.failure(); !failure.empty())
    throw std::runtime_error(fmt::format("{}: {}", results.front().simulated.argument, failure));
  return entries[0];
}

constexpr const char* kSimulate = R"(Simulates the stiffness test and the toughness test of patterns.

patterns: one design, a list of them, or a numpy array of n x 20 x 20. A design is a text as on the command line (a key
    of 14 hex digits, a pattern file, soft, interface, rigid, mix:F, checkerboard:P, laminate:x|y:R:S), a letter of a
    published pattern ("a", "b"), or an array of 20 x 20, 0 soft and 1 rigid, row 0 at the top.
params: path of a parameter file or a dict of its form (see read_parameters); None: the built-in parameters.
test: "modulus", "toughness" or "both".
fidelity: "full" (as in the thesis), "fine" (on elements of half the size), "preview" (pulled twice as fast) or
"tiny" (its numbers mean nothing).
specimens: 1 to 1000; T is the mean over so many specimens of each pattern. None: 8, of a model without variation 1.
strength_cv: variation of failure energy between regions of half a pixel: 0, or 0.02 to 0.4; None: the model's.
criterion: when elements fail: "element", "neighbourhood" or "crack_band"; None: the model's.
refine: 1 to 8, elements of 1/refine with the same specimens.
film: number of frames, 2 to 1000, of a film of specimen 0; 0: none.
progress: called as progress(share, step) with the share done, 0 to 1, in the calling thread; what it raises ends the
    call.

Returns for one design a dict, else a list of dicts: the fields of `nacre simulate --json` (docs/FORMATS.md), among
    them modulus_pa and toughness_pa in Pa, failure_strain, crack; then curves, a list of {"strain", "stress_pa"} with
    one entry per specimen; film as read_film() returns it. In a list a design whose simulation failed has the field
    error.
Raises InputError for bad input, RuntimeError where the simulation of a single design fails, KeyboardInterrupt after
    Ctrl-C as soon as running simulations have ended.
Uses all allowed cores; a full toughness test takes about two seconds of one.)";

}  // namespace

void add_simulate(py::module_& module) {
  module.def(
      "simulate",
      [](const py::object& patterns, const py::object& params, const std::string& test, const std::string& fidelity,
         std::optional<int> specimens, std::optional<double> strength_cv, const std::optional<std::string>& criterion,
         int refine, int film, const py::object& progress) {
        return simulate(patterns, params, {test, fidelity, specimens, {criterion, strength_cv}, refine, film},
                        progress);
      },
      py::arg("patterns"), py::kw_only(), py::arg("params") = py::none(), py::arg("test") = "both",
      py::arg("fidelity") = "full", py::arg("specimens") = py::none(), py::arg("strength_cv") = py::none(),
      py::arg("criterion") = py::none(), py::arg("refine") = 1, py::arg("film") = 0, py::arg("progress") = py::none(),
      kSimulate);
}

}  // namespace nacre::python
