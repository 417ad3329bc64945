#pragma once
// What functions on measurement sets have in common.

#include <cstdint>
#include <filesystem>
#include <string>

#include <pybind11/pybind11.h>

#include "material/ranges.hpp"
#include "measurement/read_set.hpp"

namespace nacre::python {

/// The usable rows of a set, with Python warnings about the others. Throws InputError.
measurement::MeasurementSet set_from(const pybind11::object& folder);

/// The ranges of a file; None: the thesis'. Throws InputError.
material::ParameterRanges ranges_from(const pybind11::object& file);

/// Parameters as parameters_from(); what they leave out is the built-in value, brought into the ranges.
material::ParameterSet start_from(const pybind11::object& value, const material::ParameterRanges& ranges);

/// A file of discretisation errors; None: the one that comes with nacre.
std::filesystem::path discretisation_floor_file(const pybind11::object& file);

/// Warns of specimens whose units are in doubt.
void warn_of_units(const measurement::MeasurementSet& set, const material::ParameterSet& model,
                   tester::Fidelity fidelity);

}  // namespace nacre::python
