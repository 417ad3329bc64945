#pragma once
// Search for eta with an emulator of features (emulator.hpp).

#include <memory>
#include <span>
#include <vector>

#include "material/ranges.hpp"
#include "sysid/fit.hpp"

namespace nacre::sysid {

/// Every batch holds the points whose predicted objective, less a share of its uncertainty, is smallest within a trust
/// region around the best trial. Poisson's ratios stay at the start: T hardly depends on them, and a few tens of
/// evaluations cannot determine them. `others`: further initial guesses.
std::unique_ptr<ParameterFit> make_emulator_fit(FitData data, const FitSettings& settings,
                                                std::span<const material::ParameterRange> ranges,
                                                std::vector<Point> others);

}  // namespace nacre::sysid
