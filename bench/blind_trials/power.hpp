#pragma once
// Power of the diagnosis: how often effects of a visibility are noticed and named, beside what is possible.

#include <string>
#include <vector>

#include "score.hpp"

namespace nacre::blind_trials {

/// Of trials of kinds `effect` and `power` with signal-to-noise ratios of 2.25 to 15, in five bins: shares that are
/// named rightly, one line per effect, and of all effects together those named and those noticed; dashed the power of
/// the likelihood-ratio test of the known effect against none at the level of a name (Neyman and Pearson 1933). SVG.
std::string power_figure(const std::vector<Score>& scores);

/// The same numbers as Markdown: rows effects, columns bins, "named, noticed, trials".
std::string power_table(const std::vector<Score>& scores);

}  // namespace nacre::blind_trials
