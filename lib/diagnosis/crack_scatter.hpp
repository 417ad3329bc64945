#pragma once
// Scatter of toughness between replicates, as a datum: its level tells how much the strength of a print varies, which
// the means of replicates hardly do.

#include <vector>

#include "diagnosis/fracture_surface.hpp"
#include "diagnosis/observations.hpp"

namespace nacre::diagnosis {

/// How much log T of layouts scatters between specimens of the simulator: at a calibration as `refined` broke there on
/// elements of h, and by how much that grows with `strength_scatter`, as runs of it that `surface` left out lie farther
/// off than runs of the base model. Level and noise as the replicates show them. Nothing where either has too few
/// specimens of one layout (`enough_dof`).
std::optional<CrackScatter> crack_scatter(const Observations& observations, const std::vector<RefinedLayout>& refined,
                                          const FractureSurface& surface, const NoiseRules& rules);

/// Adds it, with a row that it predicts: the log of the measured standard deviation of log T.
void put_crack_scatter(Observations& observations, const CrackScatter& scatter);

}  // namespace nacre::diagnosis
