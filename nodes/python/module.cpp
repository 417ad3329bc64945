#include "module.hpp"

#include <dlfcn.h>

#include <filesystem>

#include "base/no_space.hpp"
#include "base/shipped_files.hpp"
#include "store/simulation_cache.hpp"

namespace nacre::python {
namespace {

namespace py = pybind11;

template <class Exception>
void add_exception(py::module_& module, const char* name, PyObject* base, const char* meaning) {
  py::exception<Exception>& type = py::register_exception<Exception>(module, name, base);
  type.attr("__module__") = "nacre";
  type.doc() = meaning;
}

/// Behind one another: the last is asked first whether an exception is its own.
void add_exceptions(py::module_& module) {
  add_exception<InputError>(module, "InputError", PyExc_ValueError,
                            "Bad input; the message names the place and what was expected.");
  add_exception<NoSpace>(module, "NoSpace", PyExc_OSError,
                         "The disk is full; the same call succeeds once there is room.");
  add_exception<store::DatabaseUnavailable>(module, "DatabaseUnavailable", PyExc_OSError,
                                            "Another program uses the cache, or it cannot be opened.");
}

/// data/ is found from where this module lies: PREFIX/lib/python3/dist-packages/nacre, or the folder of the build.
void find_shipped_files() {
  Dl_info here{};
  if (::dladdr(reinterpret_cast<const void*>(&find_shipped_files), &here) == 0) return;
  const auto package = std::filesystem::absolute(here.dli_fname).parent_path();
  const auto prefix = package.parent_path().parent_path().parent_path().parent_path();
  std::error_code unreadable;
  const bool is_installed = std::filesystem::is_directory(prefix / "share" / "nacre", unreadable);
  set_program_folder(is_installed ? prefix / "bin" : package.parent_path());
}

}  // namespace
}  // namespace nacre::python

PYBIND11_MODULE(_nacre, module) {
  using namespace nacre::python;
  find_shipped_files();
  add_exceptions(module);
  add_patterns(module);
  add_parameters(module);
  add_simulate(module);
  add_explore(module);
  add_measure(module);
  add_calibrate(module);
  add_diagnose(module);
  add_runs(module);
  add_films(module);
  module.attr("__version__") = NACRE_VERSION;
}
