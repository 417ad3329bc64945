#pragma once
// How a game stands, in a few sentences.

#include <string>

#include "run/run_record.hpp"

namespace nacre::report {

/// HTML for the head of a page: gap and hypervolumes, equilibrium or why the game ended, the newest diagnosis,
/// fidelity.
std::string standing_sentences(const run::RunRecord& run);

/// Where the model holds faults of the testing machine, simulated and measured values mean different things: a
/// sentence, else empty.
std::string machine_in_words(const run::RunRecord& run);

}  // namespace nacre::report
