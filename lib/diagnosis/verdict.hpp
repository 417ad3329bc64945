#pragma once
// From evidence to verdict (docs/METHODS.md, "Diagnosis", step 7).

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/evidence.hpp"
#include "diagnosis/factors.hpp"

namespace nacre::diagnosis {

/// What was decided: models that stay possible, the best first; empty with `base_sufficient` and `unexplained`.
struct Decision {
  Verdict verdict = Verdict::base_sufficient;
  std::vector<FittedModel> possible;   ///< several with `named`: forms of one effect
  std::optional<FittedModel> partial;  ///< best model of an unexplained misfit
  std::optional<Gain> gain;            ///< of the one model that stays possible
  double p_outside = 1.0;  ///< chance that an unmodelled cause would give a name as surely (discrepancy_model.hpp); 1
                           ///< when not tested
  std::vector<Contrast> contrasts;        ///< of the base model's residuals, strongest first
  std::size_t loudest_part = 0;           ///< of the rows, where the base is farthest off (Anchor::parts)
  std::vector<ModulusAtBound> untold;     ///< where specimens of these materials would decide between another material
                                          ///< and a missing effect: `ambiguous`, no model possible
  std::vector<FittedModel> rivals;        ///< with laws of one condition, each of which explains the data
                                          ///< (condition_laws.hpp)
  FreeLevels beside, beside_rivals;       ///< what is free beside the model where `freed`, and beside the rivals
  std::shared_ptr<const Evidence> freed;  ///< with the free levels and exponents beside which the model explains the
                                          ///< data, where these are others than those that effects were judged beside
  std::shared_ptr<const Evidence> part;   ///< of the rows that carry the named effect, where others misfit beside it
  std::optional<FittedModel> part_fit;    ///< over these rows
  Finding finding;
};

/// Select, keep the set of models that the data cannot distinguish, or say that none fits.
Decision decide(const Evidence& evidence);

}  // namespace nacre::diagnosis
