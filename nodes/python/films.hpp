#pragma once
// Fracture films as arrays.

#include <pybind11/pybind11.h>

#include "film/film.hpp"

namespace nacre::python {

/// The dict that read_film() returns.
pybind11::dict python_of(const film::Film& film);

}  // namespace nacre::python
