#pragma once
// Which models stay possible beside the best one.

#include <vector>

#include "diagnosis/evidence.hpp"

namespace nacre::diagnosis {

/// Models that the data cannot distinguish from the best one, the best first: each fits by itself and is not excluded
/// by draws under the discretisation error of all models; where elements matter, the profile deviance decides with
/// them.
std::vector<FittedModel> confidence_set(const Evidence& evidence, const std::vector<FittedModel>& rivals,
                                        const std::vector<double>& p_fit);

}  // namespace nacre::diagnosis
