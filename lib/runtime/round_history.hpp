#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "wire/convert.hpp"

namespace nacre::runtime {

/// The rounds that a run has summed up so far, oldest first, from the validation agent's journal: complete whatever the
/// bus lost. Empty before the first one.
std::vector<wire::RoundSummary> read_rounds(const std::filesystem::path& run_folder);

/// One line for a person: gap, hypervolumes, prediction errors of new designs, errors after calibration. Round 0
/// measures nothing: "round 0: nothing measured yet; model fitted to 3 base materials (errors E 0 %, T 2 %)".
std::string in_words(const wire::RoundSummary& round);

}  // namespace nacre::runtime
