#pragma once
// The next experiments: those that best separate the models that stay possible.

#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/evidence.hpp"
#include "diagnosis/explanations.hpp"

namespace nacre::diagnosis {

/// At most rules.count of the possible tests that together would best separate these explanations (choose_tests), by
/// the information of each beyond the present measurements (PredictedTests), rules.replicates specimens of each. Fewer
/// than two models: nothing to separate. Fracture tests are simulated, one per model and test.
std::vector<NextExperiment> next_experiments(const Evidence& evidence, const std::vector<Explanation>& explanations,
                                             const TestRules& rules);

/// Moduli of homogeneous specimens of these materials, which tell whether it is another material or an effect.
std::vector<NextExperiment> specimens_of_materials(const Observations& observations,
                                                   const std::vector<ModulusAtBound>& moduli, int replicates);

}  // namespace nacre::diagnosis
