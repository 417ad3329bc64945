#pragma once
// Choice of one pattern per bin, as different as possible from what is measured and from each other (thesis Eq. 2.14).

#include <span>
#include <vector>

#include "pattern/layout.hpp"

namespace nacre::select {

/// Objective of Eq. 2.14 without its factor 1/M: the sum over the chosen of the smallest number of differing pixels to
/// anything measured or to another of the chosen; 400 where there is nothing to differ from.
int dissimilarity(std::span<const pattern::Pattern> chosen, std::span<const pattern::Pattern> measured);

/// Smallest number of differing pixels between a pattern and any of `others`; 400 where there are none.
int smallest_difference(const pattern::Pattern& pattern, std::span<const pattern::Pattern> others);

/// Index chosen from each bin (none may be empty) by beam search. The bins are taken in turn; a partial selection is
/// scored by dissimilarity() of what it holds so far. Later members can only lower a term, so the score bounds from
/// above what those members will contribute in the end, and selections of equal length compare fairly; ties go to the
/// earlier partial selection and the earlier candidate. Exact when there are no more partial selections than `width`.
/// O(width * candidates * bins).
std::vector<std::size_t> beam_search(std::span<const std::vector<pattern::Pattern>> bins,
                                     std::span<const pattern::Pattern> measured, int width);

}  // namespace nacre::select
