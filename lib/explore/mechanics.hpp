#pragma once
// Elastic quantities of patterns, for searches that use them: a hundredth of the cost of a fracture test and less.

#include "explore/search.hpp"
#include "material/parameters.hpp"
#include "tester/names.hpp"

namespace nacre::explore {

/// By the testers' own model, on `threads` cores (0: all allowed ones): moduli as a simulation of the pattern would
/// compute them, 3 ms each, and unit cells (tester/unit_cell.hpp), 0.3 ms each; those of the last model are remembered.
/// A cell that cannot be solved counts as one of 1 Pa everywhere.
Mechanics mechanics_by_tester(const material::ParameterSet& parameters, tester::Fidelity fidelity, int threads);

}  // namespace nacre::explore
