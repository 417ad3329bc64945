#pragma once
// Parameter sets as dicts: {"modulus": {...}, "toughness": {...}, "extension": {NAME: {"value": ...}}}.

#include <pybind11/pybind11.h>

#include "material/parameters.hpp"
#include "material/ranges.hpp"
#include "material/starting_model.hpp"

namespace nacre::python {

/// None: `start`. A path: a parameter file. A dict as such a file: what it leaves out is that of `start`. Warns, as the
/// command line does, of values far outside the ranges. Throws InputError.
material::ParameterSet parameters_from(const pybind11::object& value, const material::ParameterSet& start,
                                       const material::ParameterRanges& ranges = material::default_ranges());

/// material::starting_model() of such a value and of a file of ranges (None: none).
material::StartingModel starting_model_from(const pybind11::object& value, const pybind11::object& ranges);

pybind11::dict python_of(const material::ParameterSet& parameters);

}  // namespace nacre::python
