// Part of the Python module (module.hpp): calibrate, parameters that make the testers agree with a measurement set.

#include "background.hpp"
#include "base/files.hpp"
#include "base/output_path.hpp"
#include "conversion.hpp"
#include "material/parameter_file.hpp"
#include "measured.hpp"
#include "module.hpp"
#include "offline/calibration_json.hpp"
#include "offline/json_parts.hpp"
#include "parameters.hpp"

namespace nacre::python {
namespace {

namespace py = pybind11;

struct CalibrateArguments {
  py::object start, ranges, out;
  std::string fidelity;
  py::object begin_at;
  int budget, modulus_budget, hold_out;
  std::string search;
  int searches, ensemble;
  py::object discretisation_floor, store;
  std::int64_t seed;
};

void check_numbers(const CalibrateArguments& given) {
  require_range("budget", given.budget, 0, 1'000'000);
  require_range("modulus_budget", given.modulus_budget, 0, 1'000'000);
  require_range("hold_out", given.hold_out, 0, 100'000);
  require_range("searches", given.searches, 1, 100);
  require_range("ensemble", given.ensemble, 0, 1000);
}

sysid::ToughnessSearch search_from(const CalibrateArguments& given) {
  const auto search = sysid::toughness_search_from_string(given.search);
  if (!search) throw InputError("search: " + search.error().message);
  if (given.searches > 1 && !sysid::draws(*search))
    throw InputError::format("searches: {} uses no random numbers, so that several are all the same; expected 1",
                             given.search);
  return *search;
}

/// The cheaper fidelity that is calibrated first.
void add_beginning(sysid::OfflineSettings& settings, const CalibrateArguments& given) {
  if (given.begin_at.is_none()) return;
  settings.begin_at = fidelity_from(py::str(given.begin_at));
  if (*settings.begin_at >= settings.fidelity)
    throw InputError::format("begin_at {}: expected a cheaper fidelity than {}", to_string(*settings.begin_at),
                             given.fidelity);
  settings.begin_at_floor =
      sysid::read_discretisation_floor(discretisation_floor_file(given.discretisation_floor), *settings.begin_at);
}

sysid::OfflineSettings settings_from(const CalibrateArguments& given) {
  check_numbers(given);
  sysid::OfflineSettings settings;
  settings.fidelity = fidelity_from(given.fidelity);
  settings.hold_out = given.hold_out;
  settings.store = path_from(given.store, "store");
  sysid::CalibrationSettings& calibration = settings.calibration;
  material::StartingModel model = starting_model_from(given.start, given.ranges);
  calibration.ranges = model.ranges;
  calibration.start = std::move(model.parameters);
  calibration.toughness_budget = given.budget;
  calibration.modulus_budget = given.modulus_budget;
  calibration.seed = seed_from(given.seed);
  calibration.toughness_search = search_from(given);
  calibration.searches = given.searches;
  calibration.ensemble_size = given.ensemble;
  calibration.floor =
      sysid::read_discretisation_floor(discretisation_floor_file(given.discretisation_floor), settings.fidelity);
  add_beginning(settings, given);
  return settings;
}

py::object calibrate(const py::object& folder, const CalibrateArguments& given, const py::object& progress) {
  const std::string out = path_from(given.out, "out");
  if (!out.empty())
    prepare_output_file(
        out, {path_from(folder, "set"), path_from(given.ranges, "ranges"),
              path_from(given.discretisation_floor, "discretisation_floor"), path_from(given.store, "store")});
  const measurement::MeasurementSet set = set_from(folder);
  const sysid::OfflineSettings settings = settings_from(given);
  warn_of_units(set, settings.calibration.start, settings.fidelity);
  const sysid::OfflineCalibration result = in_background(progress, [&](Watch& watch) {
    return sysid::calibrate_offline(set, settings,
                                    [&](double share, std::string_view step) { watch.report(share, step); });
  });
  if (!out.empty()) write_file_atomically(out, material::to_toml(result.calibrated.parameters));
  nlohmann::ordered_json document = offline::to_json(result);
  document["rejected"] = offline::rejected_json(set.rejected);
  const py::dict dict = python_of(document);
  dict["model"] = python_of(result.calibrated.parameters);
  return dict;
}

constexpr const char* kCalibrate = R"(Fits the model's parameters to a measurement set.

set: path of a folder with measurements.csv (docs/FORMATS.md).
start: initial guess, as params of simulate(). ranges: file with the ranges of the parameters; None: the thesis'.
out: parameter file to write; None: none.
fidelity, progress: as of simulate(). begin_at: a cheaper fidelity to calibrate at first.
budget: most parameter sets tried for toughness, modulus_budget: for the modulus; 0 keeps the parameters.
hold_out: patterns kept out of the fit, to test it on.
search: "posterior" or another of `nacre calibrate --help`; searches: 1 to 100, each with its own seed.
ensemble: 0 to 1000 plausible parameter sets whose mean also predicts the designs held out.
discretisation_floor: file of discretisation errors; None: nacre's.
store: file that keeps the simulations, so that an interrupted calibration goes on.
seed: of every random choice, 0 to 2^63 - 1.

Returns the fields of `nacre calibrate --json`, among them before, after (relative errors), parameters (value,
    interval90, determined); then model, the fitted parameters as params of simulate().
Warns of rows that cannot be used. Raises InputError for bad input, KeyboardInterrupt after Ctrl-C.)";

}  // namespace

void add_calibrate(py::module_& module) {
  const py::none none;
  module.def(
      "calibrate",
      [](const py::object& set, const py::object& start, const py::object& ranges, const py::object& out,
         const std::string& fidelity, const py::object& begin_at, int budget, int modulus_budget, int hold_out,
         const std::string& search, int searches, int ensemble, const py::object& discretisation_floor,
         const py::object& store, std::int64_t seed, const py::object& progress) {
        return calibrate(set,
                         {start, ranges, out, fidelity, begin_at, budget, modulus_budget, hold_out, search, searches,
                          ensemble, discretisation_floor, store, seed},
                         progress);
      },
      py::arg("set"), py::kw_only(), py::arg("start") = none, py::arg("ranges") = none, py::arg("out") = none,
      py::arg("fidelity") = "full", py::arg("begin_at") = none, py::arg("budget") = 60, py::arg("modulus_budget") = 120,
      py::arg("hold_out") = 0, py::arg("search") = "posterior", py::arg("searches") = 1, py::arg("ensemble") = 0,
      py::arg("discretisation_floor") = none, py::arg("store") = none, py::arg("seed") = 1, py::arg("progress") = none,
      kCalibrate);
}

}  // namespace nacre::python
