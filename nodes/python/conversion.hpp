#pragma once
// Values between Python and nacre.

#include <span>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <nlohmann/json.hpp>

#include "pattern/design.hpp"
#include "tester/curve.hpp"
#include "tester/names.hpp"

namespace nacre::python {

/// A JSON document as dicts, lists and numbers; numbers that are not finite are None, as the command line's null.
pybind11::object python_of(const nlohmann::ordered_json& document);

/// {"strain": ..., "stress_pa": ...}, arrays of equal length.
pybind11::dict python_of(const tester::Curve& curve);

/// A copy of the values as an array of that shape.
template <class T>
pybind11::array_t<T> array_of(std::span<const T> values, std::vector<pybind11::ssize_t> shape) {
  pybind11::array_t<T> array(std::move(shape));
  std::copy(values.begin(), values.end(), array.mutable_data());
  return array;
}
template <class T>
pybind11::array_t<T> array_of(const std::vector<T>& values) {
  return array_of(std::span<const T>(values), {static_cast<pybind11::ssize_t>(values.size())});
}

/// A design with what stood for it.
struct NamedDesign {
  std::string argument;
  pattern::Design design;
};

/// A text as on the command line, a letter of a published pattern ("a"), a path, or an array of 20 x 20 zeros (soft)
/// and ones (rigid), row 0 at the top. Throws InputError.
NamedDesign design_from(const pybind11::handle& value);

/// One design, a list of them, or an array of n x 20 x 20.
struct NamedDesigns {
  std::vector<NamedDesign> designs;
  bool is_single = false;
};
NamedDesigns designs_from(const pybind11::object& value);

/// A text or a path as text; empty for None. Throws InputError for anything else.
std::string path_from(const pybind11::object& value, std::string_view name);

tester::Fidelity fidelity_from(const std::string& name);

/// Throws InputError unless least <= value <= most.
void require_range(std::string_view name, double value, double least, double most);

/// As scenarios and messages hold it: 0 to 2^63 - 1. Throws InputError.
std::uint64_t seed_from(std::int64_t seed);

/// Issues a Python warning; throws where the user turns warnings into errors.
void warn(const std::string& text);

}  // namespace nacre::python
