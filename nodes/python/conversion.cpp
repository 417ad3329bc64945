#include "conversion.hpp"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/shipped_files.hpp"

namespace nacre::python {
namespace {

namespace py = pybind11;

py::object number_or_none(double value) {
  if (!std::isfinite(value)) return py::none();
  return py::float_(value);
}

/// `pixels`: 400 numbers, row by row.
pattern::Layout layout_from(const double* pixels) {
  pattern::Layout layout;
  for (int row = 0; row < pattern::kSide; ++row)
    for (int column = 0; column < pattern::kSide; ++column) {
      const double pixel = pixels[row * pattern::kSide + column];
      if (pixel != 0.0 && pixel != 1.0)
        throw InputError::format("pattern: pixel [{}, {}] = {}: expected 0 (soft) or 1 (rigid)", row, column, pixel);
      layout.set(row, column, pixel == 1.0);
    }
  return layout;
}

std::string shape_of(const py::array& array) {
  std::string text;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text += fmt::format("{}{}", i > 0 ? " x " : "", array.shape(i));
  return text.empty() ? "a single value" : text;
}

/// The layouts of an array whose last two dimensions are 20 x 20.
std::vector<NamedDesign> designs_in(const py::array& array) {
  const py::ssize_t n = array.ndim();
  if (n < 2 || n > 3 || array.shape(n - 2) != pattern::kSide || array.shape(n - 1) != pattern::kSide)
    throw InputError::format("pattern: an array of {}: expected 20 x 20, or n x 20 x 20", shape_of(array));
  const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!numbers) {
    PyErr_Clear();
    throw InputError("pattern: an array of things that are no numbers: expected 0 (soft) and 1 (rigid)");
  }
  std::vector<NamedDesign> designs;
  for (py::ssize_t i = 0; i < numbers.size() / pattern::kPixels; ++i) {
    const pattern::Design design = layout_from(numbers.data() + i * pattern::kPixels);
    designs.push_back({design.name(), design});
  }
  return designs;
}

/// data/patterns/published_a.txt of "a"; other texts as they are.
std::string published(const std::string& text) {
  if (text.size() != 1) return text;
  const auto file = shipped_folder() / "data" / "patterns" / fmt::format("published_{}.txt", text);
  std::error_code unreadable;
  return std::filesystem::exists(file, unreadable) ? file.string() : text;
}

bool is_path(const py::handle& value) { return py::isinstance<py::str>(value) || py::hasattr(value, "__fspath__"); }

std::string text_of_path(const py::handle& value) { return py::str(py::module_::import("os").attr("fspath")(value)); }

}  // namespace

py::object python_of(const nlohmann::ordered_json& document) {
  switch (document.type()) {
    case nlohmann::ordered_json::value_t::object: {
      py::dict dict;
      for (const auto& [key, value] : document.items()) dict[py::str(key)] = python_of(value);
      return dict;
    }
    case nlohmann::ordered_json::value_t::array: {
      py::list list;
      for (const auto& value : document) list.append(python_of(value));
      return list;
    }
    case nlohmann::ordered_json::value_t::string:
      return py::str(document.get_ref<const std::string&>());
    case nlohmann::ordered_json::value_t::boolean:
      return py::bool_(document.get<bool>());
    case nlohmann::ordered_json::value_t::number_integer:
      return py::int_(document.get<std::int64_t>());
    case nlohmann::ordered_json::value_t::number_unsigned:
      return py::int_(document.get<std::uint64_t>());
    case nlohmann::ordered_json::value_t::number_float:
      return number_or_none(document.get<double>());
    default:
      return py::none();
  }
}

py::dict python_of(const tester::Curve& curve) {
  py::dict dict;
  dict["strain"] = array_of(curve.strain);
  dict["stress_pa"] = array_of(curve.stress_pa);
  return dict;
}

NamedDesign design_from(const py::handle& value) {
  if (is_path(value)) {
    const std::string text = text_of_path(value);
    return {text, pattern::design_from_argument(published(text))};
  }
  if (!py::isinstance<py::array>(value))
    throw InputError::format("pattern: {}: expected a text, a path or a numpy array of 20 x 20",
                             std::string(py::str(py::type::handle_of(value).attr("__name__"))));
  std::vector<NamedDesign> designs = designs_in(py::reinterpret_borrow<py::array>(value));
  if (designs.size() != 1) throw InputError::format("pattern: {} patterns, expected one", designs.size());
  return designs.front();
}

NamedDesigns designs_from(const py::object& value) {
  if (py::isinstance<py::array>(value)) {
    const auto array = py::reinterpret_borrow<py::array>(value);
    return {designs_in(array), array.ndim() == 2};
  }
  if (!py::isinstance<py::list>(value) && !py::isinstance<py::tuple>(value)) return {{design_from(value)}, true};
  NamedDesigns all;
  for (const py::handle each : value) all.designs.push_back(design_from(each));
  if (all.designs.empty()) throw InputError("patterns: an empty list: expected one design or more");
  return all;
}

std::string path_from(const py::object& value, std::string_view name) {
  if (value.is_none()) return "";
  if (is_path(value)) return text_of_path(value);
  throw InputError::format("{}: {}: expected a path", name,
                           std::string(py::str(py::type::handle_of(value).attr("__name__"))));
}

tester::Fidelity fidelity_from(const std::string& name) {
  const auto fidelity = tester::fidelity_from_string(name);
  if (!fidelity) throw InputError::format("fidelity {}: {}", name, fidelity.error().message);
  return *fidelity;
}

void require_range(std::string_view name, double value, double least, double most) {
  if (value < least || value > most) throw InputError::format("{} {}: expected {} to {}", name, value, least, most);
}

std::uint64_t seed_from(std::int64_t seed) {
  if (seed < 0) throw InputError::format("seed {}: expected a whole number from 0 to 9223372036854775807", seed);
  return static_cast<std::uint64_t>(seed);
}

void warn(const std::string& text) {
  if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

}  // namespace nacre::python
