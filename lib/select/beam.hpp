#pragma once
// Choice of one pattern per bin, as different as possible from what is measured and from each other (thesis Eq. 2.14).

#include <span>
#include <vector>

#include "pattern/layout.hpp"

namespace nacre::select {

/// Smallest number of differing pixels between a pattern and any of `others`; 400 where there are none.
int smallest_difference(const pattern::Pattern& pattern, std::span<const pattern::Pattern> others);

/// Index chosen from each bin (none may be empty) by beam search. The bins are taken in turn; a partial selection is
/// scored by Eq. 2.14 of what it holds so far: the sum over the chosen of the smallest number of differing pixels to
/// anything measured or to another of the chosen. Later members can only lower a term, so the score bounds from
/// above what those members will contribute in the end, and selections of equal length compare fairly; ties go to the
/// earlier partial selection and the earlier candidate. Exact when there are no more partial selections than `width`.
/// O(width * candidates * bins).
std::vector<std::size_t> beam_search(std::span<const std::vector<pattern::Pattern>> bins,
                                     std::span<const pattern::Pattern> measured, int width);

}  // namespace nacre::select
