#pragma once
// What `nacre simulate` prints for people.

#include <vector>

#include "offline/simulated_design.hpp"

namespace nacre::cli {

/// One line a design, below a heading.
void print_table(const std::vector<offline::SimulatedDesign>& designs, const offline::SimulateSettings& settings);

}  // namespace nacre::cli
