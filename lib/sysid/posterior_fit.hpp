#pragma once
// The most probable eta, given log T and log peak stress (feature_posterior.hpp) as an emulator (emulator.hpp) predicts
// them.

#include <memory>
#include <span>
#include <vector>

#include "material/ranges.hpp"
#include "sysid/fit.hpp"

namespace nacre::sysid {

/// Residuals of log T and log peak stress are normal, of a variance that is learnt with the floor and the scatter of
/// replicates as its prior, and the start is the centre of a weak prior. Features come from the emulator with jumps
/// averaged out, so that neither search nor result follow the luck of single fracture simulations: the result is the
/// trial that is most probable also in view of its neighbours. Every batch holds the most probable point of a trust
/// region and draws from what is possible around it. `others`: further initial guesses.
std::unique_ptr<ParameterFit> make_posterior_fit(FitData data, const FitSettings& settings,
                                                 std::span<const material::ParameterRange> ranges,
                                                 std::vector<Point> others);

}  // namespace nacre::sysid
