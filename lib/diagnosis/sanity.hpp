#pragma once

#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/observations.hpp"

namespace nacre::diagnosis {

/// Step 1 of the procedure: three specimens (least, middling and most rigid) at the parameters given, simulated again
/// with other numerics. Moduli: element size; fracture tests: all four, log T and log peak stress. Nothing for coupons,
/// which have neither mesh nor time step.
std::vector<SanityCheck> check_numerics(const Observations& observations, const material::ParameterSet& set,
                                        tester::Fidelity fidelity);

}  // namespace nacre::diagnosis
