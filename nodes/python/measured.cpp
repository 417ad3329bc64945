#include "measured.hpp"

#include "base/shipped_files.hpp"
#include "conversion.hpp"
#include "measurement/set_columns.hpp"
#include "offline/specimen_units.hpp"

namespace nacre::python {

namespace py = pybind11;

measurement::MeasurementSet set_from(const py::object& folder) {
  const std::filesystem::path path = path_from(folder, "set");
  const measurement::MeasurementSet set = measurement::read_plausible_set(path);
  for (const std::string& warning : set.warnings) warn(warning);
  for (const measurement::RejectedRow& row : set.rejected)
    warn(fmt::format("{}:{}: {}{}", (path / measurement::kTableName).string(), row.line,
                     row.column.empty() ? "" : fmt::format("column {}: ", row.column), row.reason));
  return set;
}

std::filesystem::path discretisation_floor_file(const py::object& file) {
  if (file.is_none()) return shipped_folder() / "data" / "discretisation_floor.toml";
  return path_from(file, "discretisation_floor");
}

void warn_of_units(const measurement::MeasurementSet& set, const material::ParameterSet& model,
                   tester::Fidelity fidelity) {
  for (const std::string& doubt : offline::specimen_unit_doubts(set.specimens, {model, model}, fidelity).first)
    warn(doubt);
}

}  // namespace nacre::python
