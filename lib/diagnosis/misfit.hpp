#pragma once
// Whether residuals are noise: chances of misfits and of contrasts by the bootstrap.

#include <functional>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/evidence.hpp"

namespace nacre::diagnosis {

/// A number of every draw.
std::vector<double> over_draws(const std::vector<DrawStatistics>& draws,
                               const std::function<double(const DrawStatistics&)>& value);

/// Contrasts of the base model's residuals with family-wise chances, strongest first.
std::vector<Contrast> judged_contrasts(const Evidence& evidence);

/// Conditions of the tests (rate, thickness, batch, machine, ...) that go with the one of this contrast in these
/// specimens: the same direction beyond the base, to a cosine of 0.98. Empty where the contrast is of no condition.
std::vector<std::string> conditions_alike(const Evidence& evidence, const Contrast& contrast);

/// Chance of a misfit as large as the base's when it is true: the smaller of the omnibus and the contrast test, doubled
/// because there are two of them.
double chance_of_base_misfit(const Evidence& evidence);

/// The same of another model.
double chance_of_misfit(const Evidence& evidence, const FittedModel& fit);
/// The same on other observations of the model's rows.
double chance_of_misfit(const Observations& observations, const FittedModel& fit, const DiagnosisSettings& settings);

}  // namespace nacre::diagnosis
