#pragma once
// The figures of the report of a game as inline SVG; its pieces serve other exhibits, too.

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "report/report_data.hpp"
#include "report/svg.hpp"
#include "run/run_record.hpp"

namespace nacre::report {

/// Rounds whose gamuts are drawn: of many the first, the newest and those evenly between.
std::set<int> shown_rounds(const run::RunRecord& run);

/// One plot per shown round, E against T on common axes: gamut, its front, measured patterns with their front,
/// homogeneous line, proposals.
std::vector<std::string> gamut_figures(const run::RunRecord& run);

/// Hypervolumes, gap and signed gap over the rounds; empty before the first closed round.
std::vector<std::string> round_figures(const run::RunRecord& run);

/// One plot per design with a curve, simulated against measured on common axes; designs measured last come first.
std::vector<std::string> curve_figures(const run::RunRecord& run);

inline constexpr std::size_t kMostGamutPoints = 1500;  ///< of one gamut in a figure: more only weigh on the page
PlotPoint to_point(const optimize::Performance& performance);  ///< GPa, MPa
std::vector<PlotPoint> to_points(std::span<const optimize::Performance> performances);
Range range_of(std::span<const PlotPoint> points, double PlotPoint::*coordinate);
std::vector<PlotPoint> curve_points(const tester::Curve& curve);  ///< percent, MPa
/// Stress-strain curves of notched specimens printed upright, valid ones, by design.
std::map<std::string, std::vector<tester::Curve>> measured_curves(const run::RunRecord& run);

}  // namespace nacre::report
