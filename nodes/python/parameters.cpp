#include "parameters.hpp"

#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "conversion.hpp"
#include "material/parameter_file.hpp"
#include "material/unit_doubts.hpp"
#include "module.hpp"

namespace nacre::python {
namespace {

namespace py = pybind11;

constexpr const char* kSource = "params";

std::string quoted(const py::handle& text) { return nlohmann::json(std::string(py::str(text))).dump(); }

/// A dict, list, text or number as a TOML value on one line; `key` names it in errors.
std::string toml_of(const py::handle& value, const std::string& key) {
  std::vector<std::string> parts;
  if (py::isinstance<py::dict>(value)) {
    for (const auto& [name, part] : py::reinterpret_borrow<py::dict>(value)) {
      const std::string path = fmt::format("{}{}{}", key, key.empty() ? "" : ".", std::string(py::str(name)));
      parts.push_back(fmt::format("{} = {}", quoted(name), toml_of(part, path)));
    }
    return fmt::format("{{{}}}", fmt::join(parts, ", "));
  }
  if (py::isinstance<py::str>(value)) return quoted(value);
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() == nullptr) return fmt::format("{}", number);
  PyErr_Clear();
  if (!py::isinstance<py::sequence>(value))
    throw InputError::format("{}: {}: expected a number, a list or a dict", kSource, key);
  for (const py::handle each : py::reinterpret_borrow<py::sequence>(value)) parts.push_back(toml_of(each, key));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

/// The same of the whole set: tables behind one another.
std::string toml_of(const py::dict& set) {
  std::string text;
  for (const auto& [name, table] : set)
    text += fmt::format("{} = {}\n", quoted(name), toml_of(table, std::string(py::str(name))));
  return text;
}

template <class Vector>
py::dict named(std::span<const std::string_view> names, const Vector& values) {
  py::dict dict;
  for (std::size_t i = 0; i < names.size(); ++i) dict[py::str(std::string(names[i]))] = values[i];
  return dict;
}

constexpr const char* kDefaultParameters = R"(The built-in parameters, those of data/defaults.toml.

Returns a dict as read_parameters() does.)";

constexpr const char* kReadParameters = R"(A parameter file, or a dict that leaves some out, as the whole set.

params: path of a TOML file (docs/FORMATS.md, "Parameter files"), or a dict of the same form; what is absent has its
    default.
Returns {"modulus": {...}, "toughness": {...}, "extension": {NAME: {"value": number or list}}}. Young's moduli e_*_pa
    and failure energies w_*_j_per_m3 above 0, Poisson's ratios nu_* from 0 to 0.5, damping gamma_per_s above 0.
Raises InputError naming file, line, key and what was expected; warns of values far outside the thesis' ranges.)";

material::ParameterSet read_set(const py::object& value, const material::ParameterSet& start) {
  if (value.is_none()) return start;
  if (py::isinstance<py::dict>(value))
    return material::parameters_from_toml(toml_of(py::reinterpret_borrow<py::dict>(value)), kSource, start);
  return material::read_parameters(path_from(value, kSource), start);
}

void warn_about_units(const py::object& value, const material::ParameterSet& set,
                      const material::ParameterRanges& ranges) {
  if (value.is_none()) return;
  const std::string source = py::isinstance<py::dict>(value) ? kSource : path_from(value, kSource);
  for (const std::string& doubt : material::unit_doubts(source, set, ranges)) warn(doubt);
}

}  // namespace

material::ParameterSet parameters_from(const py::object& value, const material::ParameterSet& start,
                                       const material::ParameterRanges& ranges) {
  const material::ParameterSet set = read_set(value, start);
  warn_about_units(value, set, ranges);
  return set;
}

material::StartingModel starting_model_from(const py::object& value, const py::object& ranges) {
  const auto read = [&](const material::ParameterSet& start) { return read_set(value, start); };
  const std::string file = ranges.is_none() ? "" : path_from(ranges, "ranges");
  material::StartingModel model = material::starting_model(material::ParameterReader(read), file);
  warn_about_units(value, model.parameters, model.ranges);
  return model;
}

py::dict python_of(const material::ParameterSet& parameters) {
  py::dict extensions;
  for (const auto& [name, values] : parameters.extensions) {
    py::dict extension;
    if (values.size() == 1)
      extension["value"] = values.front();
    else
      extension["value"] = array_of(values).attr("tolist")();
    extensions[py::str(name)] = extension;
  }
  py::dict all;
  all["modulus"] = named(material::modulus_parameter_names(), to_vector(parameters.modulus));
  py::dict toughness = named(material::toughness_parameter_names(), to_vector(parameters.toughness));
  toughness["strength_cv"] = parameters.strength_cv;
  toughness["criterion"] = std::string(to_string(parameters.criterion.kind));
  if (parameters.criterion.kind == material::CriterionKind::neighbourhood)
    toughness["radius_m"] = parameters.criterion.radius_m;
  if (parameters.criterion.kind == material::CriterionKind::crack_band)
    toughness["softening"] = parameters.criterion.softening;
  all["toughness"] = toughness;
  all["extension"] = extensions;
  return all;
}

void add_parameters(py::module_& module) {
  module.def(
      "default_parameters", [] { return python_of(material::default_parameters()); }, kDefaultParameters);
  module.def(
      "read_parameters",
      [](const py::object& params) { return python_of(parameters_from(params, material::default_parameters())); },
      py::arg("params"), kReadParameters);
}

}  // namespace nacre::python
