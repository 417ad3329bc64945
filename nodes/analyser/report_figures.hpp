#pragma once
// The figures of the report as inline SVG.

#include <span>
#include <string>
#include <vector>

#include "analyser/report_data.hpp"
#include "pattern/design.hpp"
#include "store/run_record.hpp"

namespace nacre::analyser {

/// One plot per round, E against T on common axes: gamut, its front, measured patterns with their front, homogeneous
/// line, proposals.
std::vector<std::string> gamut_figures(const store::RunRecord& run);

/// Hypervolumes, gap and signed gap over the rounds; empty before the first closed round.
std::vector<std::string> round_figures(const store::RunRecord& run);

/// One plot per design with a curve, simulated against measured on common axes; designs measured last come first.
std::vector<std::string> curve_figures(const store::RunRecord& run);

/// The unit of a design as a picture of 20 x 20 pixels; a homogeneous material as a plain square. `side` in px.
std::string design_picture(const pattern::Design& design, int side);

}  // namespace nacre::analyser
