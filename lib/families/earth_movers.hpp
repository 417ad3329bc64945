#pragma once
// Earth mover's distance between patterns (thesis Eqs. 2.15 and 2.16). The soft pixels of the upper-left quarter are
// the earth. Both quarters are symmetric about their diagonal, so that transport between the 55 free pixels, at the
// smaller of the distances to a pixel and to its mirror image, costs exactly what transport between the 100 cells
// costs.

#include "pattern/layout.hpp"

namespace nacre::families {

/// Cells of the quarter that free pixel `index` represents: 1 on the diagonal, else 2.
int quarter_cells(int index);

/// Smallest distance, in pixels, between free pixel `a` and free pixel `b` or its mirror image.
double free_pixel_distance(int a, int b);

/// W1 between the histograms of two patterns, in pixels, right to 1e-6. Two patterns without soft pixels are 0 apart,
/// one with and one without are infinitely far from each other.
double earth_movers_distance(const pattern::Pattern& a, const pattern::Pattern& b);

}  // namespace nacre::families
