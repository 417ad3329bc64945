#pragma once

#include "diagnosis/verdict.hpp"

namespace nacre::diagnosis {

/// Mean absolute errors on held-out patterns, base against the model that would have been selected without them: five
/// folds of whole designs (twins stay together), selection repeated in each fold among `models`, linear refits around
/// the full fits. `drop_needed` is what a model must lower chi2 by to be preferred to the base. 90 % interval by
/// bootstrap over designs.
Gain held_out_gain(const Observations& observations, const Fit& base, const std::vector<Fit>& models,
                   double drop_needed, std::uint64_t seed);

}  // namespace nacre::diagnosis
