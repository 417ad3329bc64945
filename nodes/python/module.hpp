#pragma once
// The module _nacre; each subject adds its functions from a file of its own.

#include <pybind11/pybind11.h>

namespace nacre::python {

void add_patterns(pybind11::module_& module);
void add_parameters(pybind11::module_& module);
void add_simulate(pybind11::module_& module);
void add_explore(pybind11::module_& module);
void add_measure(pybind11::module_& module);
void add_calibrate(pybind11::module_& module);
void add_diagnose(pybind11::module_& module);
void add_runs(pybind11::module_& module);
void add_films(pybind11::module_& module);

}  // namespace nacre::python
