#pragma once
// Trials of kind `fracture`: what they break, and the truths that they share.

#include "trial.hpp"

namespace nacre::blind_trials {

/// Of the truth that a trial shares with others, or of its own.
std::uint64_t seed_of_truth(const BlindTrial& trial);

/// Which of the two fixed designs it breaks: one kept emulator serves each.
std::uint64_t broken_design(const BlindTrial& trial);

/// Modulus and fracture of each of 24 upright layouts that are mostly rigid, since soft ones take minutes to part, and
/// fracture of four homogeneous materials. Of each fracture as many specimens as a pool holds.
std::vector<laboratory::Experiment> broken_designs(const BlindTrial& trial, tester::Fidelity fidelity);

/// Which specimens of a pool are a trial's replicates of an experiment, from 1, in an order drawn from its seed.
std::vector<int> drawn_from_pool(const BlindTrial& trial, std::size_t experiment);

/// Of the pool of the trial's truth, simulated where it has not been.
std::vector<Result<laboratory::TrueResponse>> responses_of_pool(const BlindTrial& trial, const TrialOptions& options,
                                                                const laboratory::Truth& truth,
                                                                const std::vector<laboratory::Experiment>& experiments);

}  // namespace nacre::blind_trials
