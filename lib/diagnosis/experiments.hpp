#pragma once

#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/verdict.hpp"

namespace nacre::diagnosis {

/// Specimens that would best tell the given models apart: rotated twins of measured designs, laminates and checkerboards of period
/// 1, 2 and 5, by the expected squared difference of predicted log E over the noise of `replicates`
/// specimens. Fewer than two models: nothing to separate.
std::vector<NextExperiment> next_experiments(const std::vector<Fit>& models, const Observations& observations, tester::Fidelity fidelity,
                                             int count, int replicates = 3);

}  // namespace nacre::diagnosis
