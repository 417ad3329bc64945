#pragma once
// Specimens of a laboratory that several trials share: a truth is simulated once, and every trial draws some specimens
// of each design from it.

#include <filesystem>
#include <vector>

#include "laboratory/laboratory.hpp"

namespace nacre::blind_trials {

/// What the laboratory responds to each experiment: what `file` (JSON lines) does not hold is simulated on all cores
/// and added to it. Throws InputError where it cannot be read or written.
std::vector<Result<laboratory::TrueResponse>> pooled_responses(const laboratory::Truth& truth,
                                                               const std::vector<laboratory::Experiment>& experiments,
                                                               const std::filesystem::path& file);

}  // namespace nacre::blind_trials
