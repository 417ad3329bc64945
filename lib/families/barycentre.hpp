#pragma once

#include <optional>
#include <span>

#include "pattern/layout.hpp"

namespace nacre::families {

/// The pattern between others by Wasserstein barycentre (thesis Eqs. 2.17-2.19, with the sum over the sources that 2.19
/// lacks). What is soft in all of them stays; what is soft in some is earth of amount 1 each, of which the barycentre
/// with the weights (positive, any sum) is found and cut at the weighted mean of the sources' cell heights, so that the weight 1 on one
/// source gives that source (the thesis' plain mean does not). Equal sources give themselves. Nothing when a source has no soft pixel of its own
/// while another has: there is no earth to move then. Some milliseconds (Clp, dual simplex).
std::optional<pattern::Pattern> barycentre(std::span<const pattern::Pattern> sources, std::span<const double> weights);

}  // namespace nacre::families
