#pragma once
// Search for eta by an algorithm that sees objective (2.8) only.

#include <memory>
#include <span>
#include <vector>

#include "material/ranges.hpp"
#include "optimize/batch_optimizer.hpp"
#include "sysid/fit.hpp"

namespace nacre::sysid {

/// In all ten dimensions, begun at the start and `others`; the trust region also at the best of them rescaled by the
/// emulator's prior.
std::unique_ptr<ParameterFit> make_objective_fit(FitData data, const FitSettings& settings,
                                                 std::span<const material::ParameterRange> ranges,
                                                 std::vector<Point> others, optimize::Algorithm algorithm);

}  // namespace nacre::sysid
