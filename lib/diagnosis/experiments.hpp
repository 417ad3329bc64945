#pragma once

#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/verdict.hpp"

namespace nacre::diagnosis {

/// At most `count` of the possible tests that together would best tell these models apart (choose_tests), by what each
/// would add to what is measured (PredictedTests), `replicates` specimens of each. Fewer than two models: nothing to
/// separate. Fracture tests are simulated, one per model and test.
std::vector<NextExperiment> next_experiments(const Evidence& evidence, const std::vector<FittedModel>& models,
                                             int count, int replicates = 3);

}  // namespace nacre::diagnosis
