#pragma once
// How large a named effect is. A name is decided against the base model, with its numerics; a size is asked of the
// named model, with numerics of its own.

#include <vector>

#include "diagnosis/verdict.hpp"

namespace nacre::diagnosis {

/// A named model at the medians of its sizes, and what is known of them.
struct NamedModel {
  FittedModel fit;  ///< base constants fitted, sizes held
  std::vector<NamedEffect> effects;
};

/// Sizes with 90 % intervals. Of an effect that changes the material under modulus tests: by the likelihood over its
/// size, base constants fitted and numerics taken anew at every size, because what elements cost goes up and down with
/// where the edges of changed regions fall between them (several hills, the base's own numerics on none of them). Of
/// others: from the local covariance, with every base constant free (one that stands on a bound is not known any better
/// for it). What an effect takes beside its size always comes from the local covariance.
NamedModel measure_size(const Evidence& evidence, const FittedModel& named);

}  // namespace nacre::diagnosis
