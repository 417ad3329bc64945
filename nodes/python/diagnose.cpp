// Part of the Python module (module.hpp): diagnose, what the simulation gets wrong about measurements.

#include "offline/diagnose.hpp"
#include "background.hpp"
#include "conversion.hpp"
#include "diagnosis/kept_emulator.hpp"
#include "measured.hpp"
#include "module.hpp"
#include "parameters.hpp"

namespace nacre::python {
namespace {

namespace py = pybind11;

py::object diagnose(const py::object& folder, const py::object& params, const py::object& ranges,
                    const std::string& fidelity, bool fracture, bool kept_emulator, int search, int bootstraps,
                    const py::object& discretisation_floor, const py::object& store, std::int64_t seed,
                    const py::object& progress) {
  require_range("search", search, 0, 1000);
  require_range("bootstraps", bootstraps, 1000, 1'000'000);
  measurement::MeasurementSet set = set_from(folder);
  if (!fracture) set = offline::without_fractures(std::move(set));
  diagnosis::DiagnosisSettings settings;
  material::StartingModel model = starting_model_from(params, ranges);
  settings.ranges = model.ranges;
  settings.start = std::move(model.parameters);
  if (!settings.start.extensions.empty())
    warn("params: their extensions are not used: a diagnosis begins with the base model");
  settings.fidelity = fidelity_from(fidelity);
  settings.seed = seed_from(seed);
  settings.bootstraps = bootstraps;
  settings.search_budget = search;
  settings.store = path_from(store, "store");
  const std::filesystem::path floor = discretisation_floor_file(discretisation_floor);
  settings.floor = diagnosis::read_modulus_floor(floor, settings.fidelity);
  settings.fracture_discretisation = diagnosis::read_fracture_discretisation(floor, settings.fidelity);
  const auto [found, unit_doubts] = in_background(progress, [&](Watch& watch) {
    settings.progress = [&](double share, std::string_view step) { watch.report(share, step); };
    if (kept_emulator) settings.fractures = diagnosis::kept_emulator(set.specimens, settings);
    return offline::diagnose_set(set, settings);
  });
  for (const std::string& doubt : unit_doubts) warn(doubt);
  return python_of(offline::diagnosis_json(found, set.rejected));
}

constexpr const char* kDiagnose = R"(Shows what the simulation gets wrong about measurements, and why.

set: path of a folder with measurements.csv (docs/FORMATS.md).
params: initial guess of the base model, as of simulate(). ranges: file with the ranges of the parameters; None: the
    thesis'.
fidelity, progress: as of simulate().
fracture: whether fracture tests take part: an hour in place of a minute.
kept_emulator: fracture tests at models about params that do not follow the data: with store, another set of the same
    layouts needs no simulation.
search: most parameter sets tried for the base model of fracture tests, 0 to 1000; 0: begin at params.
bootstraps: samples behind the thresholds, 1000 to 1,000,000.
discretisation_floor: file of discretisation errors; None: nacre's.
store: file that keeps the fracture simulations, so that an interrupted diagnosis goes on.
seed: of the bootstrap, 0 to 2^63 - 1.

Returns the fields of `nacre diagnose --json`, among them verdict, summary and candidates.
Warns of rows that cannot be used. Raises InputError for bad input, KeyboardInterrupt after Ctrl-C.)";

}  // namespace

void add_diagnose(py::module_& module) {
  const py::none none;
  module.def("diagnose", diagnose, py::arg("set"), py::kw_only(), py::arg("params") = none, py::arg("ranges") = none,
             py::arg("fidelity") = "preview", py::arg("fracture") = true, py::arg("kept_emulator") = false,
             py::arg("search") = 40, py::arg("bootstraps") = 2000, py::arg("discretisation_floor") = none,
             py::arg("store") = none, py::arg("seed") = 1, py::arg("progress") = none, kDiagnose);
}

}  // namespace nacre::python
