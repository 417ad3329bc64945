#pragma once
// Trials of the diagnosis: what is hidden, which specimens are printed, and how a trial is played.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "diagnosis/plan.hpp"
#include "laboratory/laboratory.hpp"
#include "tester/names.hpp"

namespace nacre::blind_trials {

/// One trial before it is played. Everything follows from it: designs, constants, scatter.
struct BlindTrial {
  std::string name;  ///< unique, a file name
  std::string kind;  ///< null, effect, outside, double, alike, pair, resolved, form, even
  std::uint64_t seed = 1;
  bool large = true;                ///< size of the effects: the upper or the lower third of what the laboratory draws
  bool noisy = false;               ///< twice the scatter
  std::vector<std::string> hidden;  ///< names of the laboratory's effects
};

struct TrialOptions {
  tester::Fidelity fidelity = tester::Fidelity::tiny;
  bool fracture = false;  ///< toughness specimens beside the moduli
  int nulls = 149, outside = 40, doubles = 30, alike = 10, pairs = 20, forms = 15;
  int seeds_per_effect = 3;
  std::string program;           ///< nacre under test
  std::uint64_t first_seed = 1;  ///< tuning: 1; report: from the hash of the commit
};

/// All trials of a study, nulls first.
std::vector<BlindTrial> all_trials(const TrialOptions& options);

/// One of three fixed designs of 16 layouts, by the trial's seed: random patterns over the strata, turned twins,
/// checkerboards, a second rate and a thinner twin; beside them homogeneous coupons of five mixtures, pulled with a
/// curve at both rates. Alike causes (droplets that mix, rigid ink that spreads) are played on layouts as they are and
/// nothing else. Pairs cannot be told apart: coupons at two rates, every fast one of the second batch; of those to be
/// resolved, what the diagnosis orders is printed in a third batch. Outside: eight causes that the library has no name
/// for; forms: five effects of the library in another functional form, whose family is the right answer; even: causes
/// that it has no name for and that act on all turned, or all thin, specimens by one factor.
std::vector<laboratory::Experiment> experiments_of(const BlindTrial& trial, const TrialOptions& options);

/// What the laboratory of a trial is.
laboratory::Truth truth_of(const BlindTrial& trial, const TrialOptions& options);

/// Prints and measures a trial: FOLDER/set, and sealed beside it FOLDER/set.truth.toml with how well the specimens
/// could show what is hidden (signal-to-noise, nearest rival, chance that all rivals lose; of what the library does not
/// hold the signal alone), computed before scatter is drawn.
void generate(const BlindTrial& trial, const TrialOptions& options, const std::filesystem::path& folder);

/// Adds what FOLDER/diagnosis.json orders as next experiments to FOLDER/set, a third batch; the diagnosis that ordered
/// it goes to FOLDER/first_diagnosis.json. Coupons are pulled without unloading them on the way.
void print_what_was_ordered(const BlindTrial& trial, const TrialOptions& options, const std::filesystem::path& folder);

/// `nacre diagnose FOLDER/set` as a program of its own, answer in FOLDER/diagnosis.json; fracture simulations are kept
/// in FOLDER/store. Throws InputError when it fails.
void diagnose(const TrialOptions& options, const std::filesystem::path& folder);

}  // namespace nacre::blind_trials
