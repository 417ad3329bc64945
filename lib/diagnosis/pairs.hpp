#pragma once
// Pairs of effects, where no single one fits.

#include <vector>

#include "diagnosis/evidence.hpp"

namespace nacre::diagnosis {

/// Effects that pairs are built on, the best first, by their numbers among the singles, of which there is one: alone, a
/// collinear effect may explain more than the cause, which needs a second effect.
std::vector<std::size_t> pair_anchors(const Evidence& evidence);

/// Pairs that were built on one single effect as it was fitted.
struct PairsOnSingle {
  FittedModel single;
  std::vector<FittedModel> pairs;
};

struct Pairs {
  std::vector<FittedModel> pairs;    ///< in which the second effect earns its place on top of the first, each once
  std::vector<FittedModel> singles;  ///< all single effects, refitted from where pairs with them ended
  std::vector<PairsOnSingle> built;  ///< all that was fitted, for singles that stay as they are
  bool improved = false;             ///< a single effect fits so much better that it has to be judged anew: no pairs
};

/// Pairs on the anchors. What was `built` before is taken where its single effect has not changed since.
Pairs pairs_on_best(const Evidence& evidence, std::vector<PairsOnSingle> built);

}  // namespace nacre::diagnosis
