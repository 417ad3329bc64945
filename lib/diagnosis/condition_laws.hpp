#pragma once
// Laws in place of free levels: where homogeneous specimens depend on a condition that effects were judged without
// (factors.hpp), a law of that condition which explains the data says more than one level for each of its values.

#include <string>
#include <vector>

#include "diagnosis/verdict.hpp"

namespace nacre::diagnosis {

/// Whether the differences between machines are theirs: pieces or batches that were tested on several connect them all.
bool machines_are_compared(const Observations& observations);

/// The decision with the law of each condition at work (material::condition_laws()) that explains the data in place of
/// its levels; of the strain rate in free form where it also predicts held-out specimens better. Where several laws
/// do, and none by NameRules::lead better than the next, levels stay, and the best model of each is among
/// Decision::rivals.
Decision with_condition_laws(const Evidence& evidence, Decision decision);

/// The base with each law of the strain rate by which it explains curves of homogeneous coupons without free levels,
/// the best first; none that is worse by NameRules::lead. Where it explains them by none, the same with the effects
/// that pairs are built on beside the law. Nothing without such curves, or with layouts.
std::vector<FittedModel> rate_laws_of_curves(const Evidence& evidence);

}  // namespace nacre::diagnosis
