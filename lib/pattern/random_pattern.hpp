#pragma once
// Random patterns of the design space: the first samples of a search, and the initial calibration set (thesis
// Table 3.2).

#include <vector>

#include "base/random.hpp"
#include "pattern/layout.hpp"

namespace nacre::pattern {

/// Limits of the rigid percentage of one row of Table 3.2, both included.
struct Stratum {
  int minimum_percent = 0;
  int maximum_percent = 0;
};
inline constexpr Stratum kStrata[] = {{50, 59}, {60, 69}, {70, 79}, {80, 85}};

/// A pattern with exactly this percentage of rigid pixels, 50 to 85: the pixels that the corner rule requires, then
/// randomly chosen others. (Mirror images come in fours and eights, so every whole percentage can be met.)
Pattern random_pattern(int rigid_percent, RandomStream& random);

/// A pattern with a random whole percentage of rigid pixels from 50 to 85.
Pattern random_pattern(RandomStream& random);

/// A pattern with rigid bars: two to five random rows of the quarter's nine inner ones are rigid throughout, as are the
/// outer row and, by symmetry, the same columns; each of the rectangles that they leave between them is soft with one
/// probability, drawn from 0.2 to 0.9 for the whole pattern. Bars make a pattern stiff and deflect a crack:
/// most good patterns that searches find have three to five of them (docs/studies/search.md).
Pattern random_barred_pattern(RandomStream& random);

/// `count` different patterns spread over the strata of Table 3.2 in turn, so that earlier strata get one more when
/// count is no multiple of 4 (10: 3, 3, 2, 2); in each, the whole percentage is random. In the order stratum 0, 1, 2,
/// 3, 0, 1, ...
std::vector<Pattern> stratified_patterns(int count, RandomStream& random);

}  // namespace nacre::pattern
