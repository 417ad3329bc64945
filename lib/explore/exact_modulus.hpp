#pragma once
// The modulus itself, for searches that may ask for it: a thousandth of what a fracture costs.

#include "explore/search.hpp"
#include "tester/tester.hpp"

namespace nacre::explore {

/// Moduli by the tester, 3 ms of a core each, on `threads` of them (0: all allowed cores). The same as a simulation of
/// the pattern would tell.
ModulusOf modulus_by_tester(const material::ParameterSet& parameters, tester::Fidelity fidelity, int threads);

}  // namespace nacre::explore
