#pragma once
// Where a learned search begins anew once it stands still.

#include <span>

#include "explore/search.hpp"

namespace nacre::explore {

/// The samples that the next batch goes by, of all in their order of evaluation. A search that stands still has found
/// what its family of patterns holds, and others lie too far for its steps. It therefore goes by *islands*: each begins
/// with patterns with bars, knows its own samples alone and ends when it stands still. After every island but the first
/// the search goes by all samples until they stand still together; then comes the next island. To stand still is to
/// have a hypervolume (staircase) that has grown by less than a hundredth over the last `patience` samples, after at
/// least twice as many on an island, once as many on all together. Empty when an island is about to begin; everything
/// when `patience` is 0. `batch`: samples told at once.
std::span<const Evaluated> samples_to_go_by(std::span<const Evaluated> evaluated, int patience, int batch);

}  // namespace nacre::explore
