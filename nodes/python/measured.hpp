#pragma once
// What functions on measurement sets have in common.

#include <cstdint>
#include <filesystem>
#include <string>

#include <pybind11/pybind11.h>

#include "material/parameters.hpp"
#include "measurement/read_set.hpp"

namespace nacre::python {

/// The usable rows of a set, with Python warnings about the others. Throws InputError.
measurement::MeasurementSet set_from(const pybind11::object& folder);

/// A file of discretisation errors; None: the one that comes with nacre.
std::filesystem::path discretisation_floor_file(const pybind11::object& file);

/// Warns of specimens whose units are in doubt.
void warn_of_units(const measurement::MeasurementSet& set, const material::ParameterSet& model,
                   tester::Fidelity fidelity);

}  // namespace nacre::python
