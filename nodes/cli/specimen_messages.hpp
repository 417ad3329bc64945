#pragma once
// Specimens and reviews of them as messages, and those that a run has already.

#include <map>
#include <optional>
#include <string>

#include "measurement/specimen_record.hpp"
#include "run_access.hpp"
#include "runtime/node_core.hpp"

namespace nacre::cli {

/// MEASUREMENT of a specimen that nacre did not order by name; long curves thinned, history in the note.
runtime::Message measurement_message(const measurement::SpecimenRecord& specimen, tester::Fidelity fidelity);

/// The specimen of a message with what its note says of its history in the columns that it came from, too.
measurement::SpecimenRecord with_history_of_note(measurement::SpecimenRecord specimen);

/// Content hashes of the measurements that the nodes which keep them have, by specimen; the first one of a name counts.
/// Empty of a node whose journal is not on this machine.
struct HeldMeasurements {
  std::map<std::string, std::string> validation_agent;
  std::map<std::string, std::string> analyser;
};
/// Enters the payload of a MEASUREMENT that a node took in; those of another fidelity it refused.
void enter(std::map<std::string, std::string>& held, const std::string& payload, tester::Fidelity fidelity);
std::map<std::string, std::string> held_by_analyser(const RunAccess& run);
HeldMeasurements held_measurements(const RunAccess& run);

/// Why a node that has another measurement of the specimen's name keeps it, with what to do, as a sentence; nothing
/// where this one, by its hash, can be the specimen's at both.
std::optional<std::string> against_measurement(const HeldMeasurements& held, const std::string& specimen,
                                               const std::string& hash);

/// All that is held, by specimen: what the validation agent has, else what reached the analyser alone.
std::map<std::string, std::string> hashes_by_specimen(const RunAccess& run);

/// The highest revision of each specimen's reviews so far: a review of one more wins.
std::map<std::string, int> highest_revisions(const RunAccess& run);

}  // namespace nacre::cli
