// Part of the Python module (module.hpp): measure, the virtual laboratory.

#include <algorithm>

#include "background.hpp"
#include "base/output_path.hpp"
#include "conversion.hpp"
#include "laboratory/measure_set.hpp"
#include "module.hpp"

namespace nacre::python {
namespace {

namespace py = pybind11;

laboratory::Campaign campaign_from(const py::object& patterns, const std::string& test,
                                   const std::string& orientation) {
  laboratory::Campaign campaign;
  for (const NamedDesign& named : designs_from(patterns).designs) campaign.designs.push_back(named.design);
  if (test == "modulus" || test == "toughness")
    campaign.tests = {*tester::test_kind_from_string(test)};
  else if (test != "both")
    throw InputError::format("test {}: expected modulus, toughness or both", test);
  if (orientation == "90")
    campaign.orientations_deg = {90.0};
  else if (orientation == "both")
    campaign.orientations_deg = {0.0, 90.0};
  else if (orientation != "0")
    throw InputError::format("orientation {}: expected 0, 90 or both", orientation);
  return campaign;
}

py::dict measure(const py::object& patterns, const py::object& lab, const py::object& out, const std::string& test,
                 const py::object& orientation, const py::object& progress) {
  const laboratory::Campaign campaign = campaign_from(patterns, test, py::str(orientation));
  const std::string laboratory_file = path_from(lab, "lab"), folder = path_from(out, "out");
  if (folder.empty()) throw InputError("out: expected the folder of the measurement set");
  prepare_output_folder(folder);
  const auto records = in_background(progress, [&](Watch& watch) {
    return laboratory::measure_set(laboratory_file, folder, campaign,
                                   [&](double share, int, int) { watch.report(share, "measuring"); });
  });
  py::dict result;
  result["specimens"] = records.size();
  result["valid"] = std::ranges::count_if(records, [](const auto& record) { return record.valid; });
  result["set"] = folder;
  return result;
}

constexpr const char* kMeasure = R"(Measures patterns in the virtual laboratory.

patterns: as of simulate(). lab: path of a laboratory file, LAB.toml (docs/FORMATS.md).
out: folder of the measurement set that is written; OUT.truth.toml keeps the hidden parameters.
test: "modulus", "toughness" or "both".
orientation: 0 along the load, 90 across it, "both": a specimen and its turned twin.
progress: as of simulate().

Returns the fields of `nacre measure --json`: specimens, valid (numbers), set (the folder).
Raises InputError for bad input or a folder that holds a set already, KeyboardInterrupt after Ctrl-C; then nothing is
    written.)";

}  // namespace

void add_measure(py::module_& module) {
  module.def("measure", measure, py::arg("patterns"), py::arg("lab"), py::arg("out"), py::kw_only(),
             py::arg("test") = "both", py::arg("orientation") = 0, py::arg("progress") = py::none(), kMeasure);
}

}  // namespace nacre::python
