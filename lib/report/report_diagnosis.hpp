#pragma once
// What the diagnosis of each round says.

#include <string>
#include <string_view>

#include "report/exhibit.hpp"
#include "run/run_record.hpp"

namespace nacre::report {

Exhibit diagnosis_exhibit(const run::RunRecord& run);

/// A verdict of a diagnosis, as its wire value, in plain words.
std::string verdict_in_words(const std::string& verdict);

/// The status of a candidate effect, as its wire value, in plain words: explains it, does not explain it, no sign of
/// it, these tests cannot say. `p_family_wise`: chance that the best of all candidates does as well.
std::string status_in_words(std::string_view status, double p_family_wise);

}  // namespace nacre::report
