#pragma once
// Pairs of effects, where no single one fits.

#include <vector>

#include "diagnosis/evidence.hpp"

namespace nacre::diagnosis {

struct Pairs {
  std::vector<FittedModel> pairs;    ///< in which the second effect earns its place on top of the first, each once
  std::vector<FittedModel> singles;  ///< all single effects, refitted from where pairs with them ended
  bool improved = false;             ///< a single effect fits so much better that it has to be judged anew: no pairs
};

/// Pairs on the best single effects: alone, a collinear effect may explain more than the cause, which needs a second
/// effect.
Pairs pairs_on_best(const Evidence& evidence);

}  // namespace nacre::diagnosis
