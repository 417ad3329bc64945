#pragma once

#include <string>

#include "store/run_record.hpp"

namespace nacre::report {

/// The run as one self-contained HTML page, readable offline: standing, gamuts with fronts and measured points,
/// hypervolumes and gap, errors beside the thesis' figures, improvement over homogeneous mixtures, curves simulated
/// against measured, proposed patterns, diagnosis, specimens.
std::string render_report(const store::RunRecord& run, const std::string& run_id);

}  // namespace nacre::report
