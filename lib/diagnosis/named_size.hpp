#pragma once
// How large a named effect is. A name is decided against the base model, its noise included; a size is asked of the
// named model, and has a noise of its own.

#include <vector>

#include "diagnosis/verdict.hpp"

namespace nacre::diagnosis {

/// `named` fitted once more, with what finer elements change at its own constants. Beside the base's fit, which bent
/// itself towards the data and may stand on bounds of its ranges, they change something else.
Fit fit_for_size(const Evidence& evidence, const Fit& named);

/// Size and 90 % interval of every effect of `fit`, from the local covariance with every constant of the base free (one
/// that stands on a bound is not known any better for it); Student's factor for the replicate scatter.
std::vector<NamedEffect> named_effects(const Evidence& evidence, Fit fit);

}  // namespace nacre::diagnosis
