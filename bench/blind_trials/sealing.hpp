#pragma once
// Visibility of what a trial hides, computed before scatter is drawn.

#include <string>
#include <vector>

#include "trial.hpp"

namespace nacre::blind_trials {

/// What a trial prints and measures, before scatter is drawn.
struct Printed {
  std::vector<laboratory::Experiment> experiments;
  std::vector<Result<laboratory::TrueResponse>> responses;  ///< of the truth, one per experiment
  std::vector<measurement::SpecimenRecord> specimens;       ///< without values, so many of each experiment in turn
  std::vector<laboratory::Replicate> replicates;            ///< one per specimen
};

/// Tables [[signal]] of the truth file: the visibility of every hidden effect in moduli and coupons beyond what the
/// base imitates, by the laboratory's own simulations with it alone and with nothing; of known effects the nearest
/// rival too. Throws InputError.
std::string signals_of(const BlindTrial& trial, const TrialOptions& options, const laboratory::Truth& truth,
                       const Printed& printed);

/// The truth with its only effect at the size of this signal-to-noise ratio within 5 %, as far as the range of the
/// effect allows. O(10) simulations of the set. Throws InputError.
laboratory::Truth sized_to(double snr, const BlindTrial& trial, const TrialOptions& options, laboratory::Truth truth,
                           const Printed& printed);

}  // namespace nacre::blind_trials
