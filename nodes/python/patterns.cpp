// Part of the Python module (module.hpp): patterns as arrays and as keys.

#include "conversion.hpp"
#include "module.hpp"

namespace nacre::python {
namespace {

namespace py = pybind11;

py::array_t<std::uint8_t> pattern_of(const py::object& design) {
  const NamedDesign named = design_from(design);
  const pattern::Layout* layout = named.design.layout();
  if (layout == nullptr) throw InputError::format("{}: a homogeneous design has no pattern", named.argument);
  py::array_t<std::uint8_t> pixels({pattern::kSide, pattern::kSide});
  for (int row = 0; row < pattern::kSide; ++row)
    for (int column = 0; column < pattern::kSide; ++column)
      pixels.mutable_at(row, column) = layout->rigid(row, column) ? 1 : 0;
  return pixels;
}

constexpr const char* kPattern = R"(The pixels of a design.

pattern: what simulate() takes, but no homogeneous design.
Returns uint8 of 20 x 20: 0 soft, 1 rigid; row 0 at the top, column 0 at the left of the specimen.
Raises InputError for what is no pattern.)";

constexpr const char* kKey = R"(The canonical name of a design.

pattern: what simulate() takes.
Returns 14 hex digits for a pattern of eightfold symmetry, `L` and 100 hex digits for another one, or `soft`,
`interface`, `rigid`, `mix:F`.
Raises InputError for what is no design.)";

}  // namespace

void add_patterns(py::module_& module) {
  module.def("pattern", pattern_of, py::arg("pattern"), kPattern);
  module.def(
      "key", [](const py::object& pattern) { return design_from(pattern).design.name(); }, py::arg("pattern"), kKey);
}

}  // namespace nacre::python
