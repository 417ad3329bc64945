#pragma once
// How the fits of eta move: seven directions in natural logarithms of the parameters, and the search over them.

#include <array>
#include <functional>
#include <span>

#include "sysid/fit.hpp"

namespace nacre::sysid {

/// Two common scales (all moduli, all failure energies), the moduli and failure energies of soft and interface relative
/// to the rigid material's, and the damping. Poisson's ratios stay.
inline constexpr int kMoveCount = 7;
using Move = std::array<double, kMoveCount>;

/// `from` moved, and kept in the cube. `spans` as spans_of() gives them.
Point moved(const Point& from, const Move& move, std::span<const double> spans);

/// The move of both common scales, each within `reach`, of smallest `cost` on a grid of `steps` per axis, two at least.
Move best_scales(const std::function<double(const Move&)>& cost, double reach, int steps);

/// The move of smallest `cost` that is found within `radius` in every direction, thrice that in the common scales,
/// which are well predicted: a grid over the scales, then NLopt's subplex, since costs may have kinks. Deterministic.
Move best_move(const std::function<double(const Move&)>& cost, double radius);

}  // namespace nacre::sysid
