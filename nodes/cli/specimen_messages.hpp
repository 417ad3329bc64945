#pragma once
// Specimens and judgements on them as messages, and what a run has of them already.

#include <map>
#include <string>

#include "measurement/measurement.hpp"
#include "run_access.hpp"
#include "runtime/node_core.hpp"

namespace nacre::cli {

/// MEASUREMENT of a specimen that nacre did not order by name; long curves thinned, history in the note.
runtime::Message measurement_message(const measurement::SpecimenRecord& specimen, tester::Fidelity fidelity);

/// Content hash of the measurement that the validation agent has of each specimen; the first one counts.
std::map<std::string, std::string> hashes_by_specimen(const RunAccess& run);

/// One more than the highest revision of a specimen's reviews so far, so that this judgement wins.
int next_revision(const RunAccess& run, const std::string& specimen);

}  // namespace nacre::cli
