#pragma once
// Gamuts as columns.

#include <vector>

#include <pybind11/pybind11.h>

#include "explore/search.hpp"

namespace nacre::python {

/// Adds arrays of equal length: pattern (keys), modulus_pa, toughness_pa, specimens (behind T),
/// toughness_se_pa (0: unknown), is_on_front.
void add_gamut(pybind11::dict& dict, const std::vector<explore::Evaluated>& gamut);

}  // namespace nacre::python
