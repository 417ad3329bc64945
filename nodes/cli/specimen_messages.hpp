#pragma once
// Specimens and reviews of them as messages, and those that a run has already.

#include <map>
#include <optional>
#include <string>

#include "base/result.hpp"
#include "game/measurement_book.hpp"
#include "game/withdrawal_book.hpp"
#include "measurement/specimen_record.hpp"
#include "run_access.hpp"
#include "runtime/node_core.hpp"

namespace nacre::cli {

/// The specimen of a message with what its note says of its history in the columns that it came from, too.
measurement::SpecimenRecord with_history_of_note(measurement::SpecimenRecord specimen);

/// The report of a specimen that counts at a node, without its values.
struct HeldReport {
  int round = -1;  ///< that it was ordered in, and by which order
  std::string order_id = {};
  game::Amendment amendment = {};
  std::string content = {};  ///< hash of its values alone
};
using HeldReports = std::map<std::string, HeldReport>;  ///< by specimen

/// What the nodes that keep measurements have. Empty of a node whose journal is not on this machine.
struct HeldMeasurements {
  HeldReports validation_agent;
  HeldReports analyser;
};
/// Enters the payload of a MEASUREMENT that a node took in; those of another fidelity it refused.
void enter(HeldReports& held, const std::string& payload, tester::Fidelity fidelity);
HeldReports held_by_analyser(const RunAccess& run);
HeldMeasurements held_measurements(const RunAccess& run);

/// A specimen on its way into a run.
struct HandIn {
  runtime::Message message;
  HeldReport report;         ///< that it becomes
  bool is_repeated = false;  ///< the validation agent has it already
};

/// How a specimen is handed in: as the report that is held of it where that has the same values, as its amendment by
/// `amend` (by whom and why, its revision is found) where it has others. Error, with what to do: others are held, and
/// nobody amends them.
Result<HandIn> hand_in(const HeldMeasurements& held, const measurement::SpecimenRecord& specimen,
                       tester::Fidelity fidelity, const std::optional<game::Amendment>& amend = {});

/// Why a node that has another measurement of the specimen's name goes by that one, with what to do, as a sentence;
/// nothing where `report` can be the specimen's at both.
std::optional<std::string> against_measurement(const HeldMeasurements& held, const std::string& specimen,
                                               const HeldReport& report);

/// The highest revision of each specimen's reviews so far: a review of one more wins.
std::map<std::string, int> highest_revisions(const RunAccess& run);

/// WITHDRAWAL of an order, its revision one more than the highest so far.
runtime::Message withdrawal_message(const RunAccess& run, const std::string& order_id, const game::Withdrawal& said);

}  // namespace nacre::cli
