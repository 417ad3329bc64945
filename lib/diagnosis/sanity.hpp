#pragma once
// Checks before anything is called physics: sensitivity to the discretisation, and replicates that do not agree.

#include <string>
#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/observations.hpp"

namespace nacre::diagnosis {

/// Step 1 of the procedure, a change is `numerical` beyond so many standard errors: three specimens (least, middling
/// and most rigid) at the parameters given, simulated again with other discretisations. Moduli: element size; fracture
/// tests: element size, time step, rate and recording, by log T and log peak stress. Nothing for coupons, which have
/// neither mesh nor time step.
std::vector<SanityCheck> check_discretisation(const Observations& observations, const material::ParameterSet& set,
                                              tester::Fidelity fidelity, double numerical);

/// Groups of replicates of which some are out of line (measurement::review_replicates), by design and test: "modulus of
/// 577fffe9fffdef". A value mistyped looks like an unmodelled cause.
std::vector<std::string> groups_out_of_line(const std::vector<measurement::SpecimenRecord>& specimens);

}  // namespace nacre::diagnosis
