#pragma once
// What an effect must pass before it is named (docs/METHODS.md, "Diagnosis", step 7): each effect of a model by itself,
// given the other one.

#include <optional>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/evidence.hpp"

namespace nacre::diagnosis {

/// Whether an unmodelled cause could look like a model of one or two effects.
struct NameTests {
  double p_outside = 1.0;  ///< chance that a discrepancy model lets an effect lead it by as much, the largest of all
  std::optional<Finding> objection = {};  ///< why there is no name; nothing: every test is passed
};

/// Tests the effects of `model`. Of a pair each must lead a discrepancy model, a contrast and a factor on one condition
/// that act beside the other effect alone, by its own signal: a distortion that no effect describes must not be shared
/// out among two.
NameTests tested_for_a_name(const Evidence& evidence, const FittedModel& model);

}  // namespace nacre::diagnosis
