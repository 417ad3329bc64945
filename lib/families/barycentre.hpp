#pragma once

#include <optional>
#include <span>

#include "pattern/layout.hpp"

namespace nacre::families {

/// How the barycentre's earth becomes soft pixels. Both return a source that has all the weight.
enum class BarycentreCut {
  /// Cells at least as high as the weighted mean of the sources' cell heights (the thesis' plain mean does not
  /// return sources). For patterns of nearly equal amounts; between others it leaves too little soft, down to almost
  /// nothing.
  height,
  /// The highest cells, as many as the weighted mean of the sources' numbers of cells (fewer where earth overlaps).
  amount,
};

/// The pattern between others by Wasserstein barycentre (thesis Eqs. 2.17-2.19, with the sum over the sources that 2.19
/// lacks). What is soft in all of them stays; what is soft in some is earth of amount 1 each, of which the barycentre
/// with the weights (positive, any sum) is found and cut into pixels. Equal sources return themselves. Nothing when a
/// source has no soft pixel of its own while another has: there is no earth to move. Some milliseconds (Clp, dual
/// simplex).
std::optional<pattern::Pattern> barycentre(std::span<const pattern::Pattern> sources, std::span<const double> weights,
                                           BarycentreCut cut = BarycentreCut::height);

}  // namespace nacre::families
