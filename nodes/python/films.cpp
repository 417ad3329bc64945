#include "films.hpp"

#include "conversion.hpp"
#include "film/film_file.hpp"
#include "module.hpp"

namespace nacre::python {
namespace {

namespace py = pybind11;

/// Strain, stress and number of broken elements of every frame.
void add_course(py::dict& dict, const film::Film& film) {
  const auto count = static_cast<py::ssize_t>(film.frames.size());
  py::array_t<double> strain(count), stress_pa(count);
  py::array_t<std::int64_t> broken(count);
  for (py::ssize_t i = 0; i < count; ++i) {
    const film::FilmFrame& frame = film.frames[static_cast<std::size_t>(i)];
    strain.mutable_at(i) = frame.strain;
    stress_pa.mutable_at(i) = frame.stress_pa;
    broken.mutable_at(i) = frame.broken;
  }
  dict["strain"] = strain;
  dict["stress_pa"] = stress_pa;
  dict["broken"] = broken;
}

py::array_t<double> energy_of(const film::Film& film) {
  py::array_t<double> energy({static_cast<int>(film.frames.size()), film.rows, film.columns});
  double* next = energy.mutable_data();
  for (const film::FilmFrame& frame : film.frames)
    for (const std::uint8_t level : frame.energy_level) *next++ = film.energy_j_per_m3(level);
  return energy;
}

py::array_t<double> displacement_of(const film::Film& film) {
  py::array_t<double> displacement({static_cast<int>(film.frames.size()), film.rows + 1, film.columns + 1, 2});
  double* next = displacement.mutable_data();
  for (const film::FilmFrame& frame : film.frames)
    for (int node = 0; node < film.node_count(); ++node) {
      *next++ = film.displacement_x_m(frame, node);
      *next++ = film.displacement_y_m(frame, node);
    }
  return displacement;
}

py::dict breaks_of(const film::Film& film) {
  const auto count = static_cast<py::ssize_t>(film.crack.order.size());
  py::array_t<std::int64_t> element(count);
  py::array_t<double> strain(count);
  for (py::ssize_t i = 0; i < count; ++i) {
    element.mutable_at(i) = film.crack.order[static_cast<std::size_t>(i)].element;
    strain.mutable_at(i) = film.crack.order[static_cast<std::size_t>(i)].strain;
  }
  py::dict breaks;
  breaks["element"] = element;
  breaks["strain"] = strain;
  return breaks;
}

constexpr const char* kReadFilm = R"(A fracture film: a .film file of `nacre simulate --frames` or of RUN/films.

path: the file.
Returns a dict, with f frames of r rows and c columns of elements, row 0 at the bottom of the specimen:
    design, fidelity, end: texts; columns, rows; element_size_m, toughness_pa, peak_stress_pa, failure_strain: numbers;
    curve: {"strain", "stress_pa"}, at most 256 points;
    material: uint8 of r x c, before the test: 0 soft, 1 rigid, 2 interface, 3 empty;
    strain, stress_pa, broken: of f, broken the number of failed elements;
    energy_j_per_m3: f x r x c, strain energy density in 48 logarithmic levels;
    displacement_m: f x (r + 1) x (c + 1) x 2, of the nodes, along x and y;
    breaks: {"element", "strain"} in the order of failing, element = row * c + column.
Raises InputError for a file that is no film or is damaged.)";

}  // namespace

py::dict python_of(const film::Film& film) {
  py::dict dict;
  dict["design"] = film.design;
  dict["fidelity"] = film.fidelity;
  dict["columns"] = film.columns;
  dict["rows"] = film.rows;
  dict["element_size_m"] = film.element_size_m;
  dict["toughness_pa"] = film.toughness_pa;
  dict["peak_stress_pa"] = film.peak_stress_pa;
  dict["failure_strain"] = film.failure_strain;
  dict["end"] = film.end;
  dict["curve"] = python_of(film.curve);
  dict["material"] = array_of(std::span<const std::uint8_t>(film.material), {film.rows, film.columns});
  add_course(dict, film);
  dict["energy_j_per_m3"] = energy_of(film);
  dict["displacement_m"] = displacement_of(film);
  dict["breaks"] = breaks_of(film);
  return dict;
}

void add_films(py::module_& module) {
  module.def(
      "read_film", [](const py::object& path) { return python_of(film::read_film(path_from(path, "path"))); },
      py::arg("path"), kReadFilm);
}

}  // namespace nacre::python
