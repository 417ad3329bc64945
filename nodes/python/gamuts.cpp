#include "gamuts.hpp"

#include "conversion.hpp"
#include "optimize/pareto.hpp"

namespace nacre::python {

namespace py = pybind11;

void add_gamut(py::dict& dict, const std::vector<explore::Evaluated>& gamut) {
  const std::vector<optimize::Performance> points = explore::performances_of(gamut);
  const std::vector<int> ranks = optimize::non_dominated_ranks(points);
  const auto count = static_cast<py::ssize_t>(gamut.size());
  py::list keys;
  py::array_t<double> modulus_pa(count), toughness_pa(count), toughness_se_pa(count);
  py::array_t<int> specimens(count);
  py::array_t<bool> is_on_front(count);
  for (py::ssize_t i = 0; i < count; ++i) {
    const auto index = static_cast<std::size_t>(i);
    keys.append(gamut[index].pattern.key());
    modulus_pa.mutable_at(i) = points[index].modulus_pa;
    toughness_pa.mutable_at(i) = points[index].toughness_pa;
    specimens.mutable_at(i) = gamut[index].sampling.specimens;
    toughness_se_pa.mutable_at(i) = gamut[index].sampling.toughness_se_pa;
    is_on_front.mutable_at(i) = ranks[index] == 1;
  }
  dict["pattern"] = py::module_::import("numpy").attr("array")(keys, "U14");
  dict["modulus_pa"] = modulus_pa;
  dict["toughness_pa"] = toughness_pa;
  dict["specimens"] = specimens;
  dict["toughness_se_pa"] = toughness_se_pa;
  dict["is_on_front"] = is_on_front;
}

}  // namespace nacre::python
