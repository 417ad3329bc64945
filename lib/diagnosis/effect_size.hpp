#pragma once
// Effect sizes. A name is decided against the base model, with its discretisation error; a size is estimated from the
// named model, with its own: profile deviance D(s) = min over the base constants of -2 log likelihood.

#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/evidence.hpp"

namespace nacre::diagnosis {

/// A named model at the medians of its effect sizes, and their intervals.
struct NamedModel {
  FittedModel fit;  ///< base constants fitted, sizes held
  std::vector<NamedEffect> effects;
};

/// Effect sizes with 90 % intervals. Of an effect that changes the material under modulus tests: by the likelihood over
/// its size, base constants fitted and discretisation error computed anew at every size, because this error goes up and
/// down with where the edges of changed regions fall between the elements (several local maxima, the base's own
/// discretisation error at none of them). Of others: from the local covariance, with every base constant free (one that
/// is at its bound is not better known for it). Further parameters of an effect always come from the local covariance.
NamedModel measure_size(const Evidence& evidence, const FittedModel& named);

}  // namespace nacre::diagnosis
