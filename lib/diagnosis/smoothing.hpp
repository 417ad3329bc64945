#pragma once
// Curves without the scatter of single readings: a piecewise linear least-squares fit.

#include "diagnosis/procedure.hpp"
#include "tester/curve.hpp"

namespace nacre::diagnosis {

/// The polyline of at most 64 pieces, equally long in strain, that lies closest to the readings (least squares). Of
/// many readings that scatter the first to reach a stress comes too early and the largest is too large, a bias that is
/// the same in every replicate. The noisier the readings, the fewer the pieces (8 at least): the scatter of a
/// knot is to stay below 0.3 % of the largest stress. A curve of less than 128 readings, or one that does not
/// scatter (1e-4 of its largest stress), comes back as it is. Strain must never decrease.
tester::Curve smoothed(const tester::Curve& curve, const CurveReading& reading);

}  // namespace nacre::diagnosis
