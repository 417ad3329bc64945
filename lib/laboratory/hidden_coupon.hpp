#pragma once

#include <vector>

#include "laboratory/specimen_raster.hpp"
#include "tester/curve.hpp"
#include "tester/loading.hpp"

namespace nacre::laboratory {

/// Strain at which an unnotched homogeneous coupon, pulled at the machine's rate, has taken up `share` of the energy
/// that parts it (per volume), with the hidden effects of its material; at most 2.
double coupon_strain(const Truth& truth, double rigid_fraction, const Making& making, double share);

/// Curve of an unnotched homogeneous coupon at the machine's rate, pulled and unloaded along `strains` from 0, with the
/// hidden effects of its material. Stress of the softened coupon is the mean over its cross-section.
tester::Curve coupon_curve(const Truth& truth, double rigid_fraction, const Making& making,
                           const std::vector<double>& strains);

/// The same along a programme with pauses, about `step` of strain between its points: relaxing while strain is held,
/// then unloaded to zero force and recovering there. Strain falls along the dwell, stress is zero.
tester::Curve paused_curve(const Truth& truth, double rigid_fraction, const Making& making,
                           const tester::Loading& loading, double step);

}  // namespace nacre::laboratory
