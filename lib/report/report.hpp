#pragma once

#include <string>

#include "run/run.hpp"

namespace nacre::report {

/// The run as one self-contained HTML page, readable offline: the best design and its gain over homogeneous mixtures,
/// how the game stands, gamuts with fronts and measured points, hypervolumes and gap, prediction errors and the thesis'
/// figures, curves simulated and measured, proposed patterns, diagnosis, specimens.
std::string render_report(const run::RunRecord& run, const std::string& run_id);

/// The same of a run that is read, with the gamuts that are shown.
std::string render_report(run::Run& run, const std::string& run_id);

}  // namespace nacre::report
