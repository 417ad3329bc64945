#pragma once
// Trials of the diagnosis: hidden effects, specimens, and the steps of a trial.

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
  std::string kind;  ///< null, effect, power, outside, double, alike, pair, resolved, form, even,
                     ///< distorted, homogeneous, loops, machines, spectrum, warm, fracture
  std::uint64_t seed = 1;
  bool large = true;                ///< size of the effects: the upper or the lower third of what the laboratory draws
  bool noisy = false;               ///< twice the scatter
  std::vector<std::string> hidden;  ///< names of the laboratory's effects
  double signal = 0.0;              ///< signal-to-noise ratio that sizes the effect of kind `power`; 0: drawn
  std::uint64_t truth_seed = 0;     ///< of the truth that trials of kind `fracture` share; 0: a truth of its own
};

struct TrialOptions {
  tester::Fidelity fidelity = tester::Fidelity::tiny;
  bool fracture = false;  ///< toughness specimens besides the moduli
  int nulls = 149, outside = 40, doubles = 30, alike = 10, pairs = 20, forms = 15, distorted = 60, homogeneous = 50;
  int loops = 40, machines = 30, spectra = 40, warm = 30;
  int power = 0;  ///< trials of each effect and signal
  int fracture_nulls = 20, fracture_seeds = 3;
  int seeds_per_effect = 3;
  std::string program;           ///< nacre under test
  std::filesystem::path pools;   ///< folder of what trials of kind `fracture` share: specimens of each truth, and one
                                 ///< emulator of each design
  std::uint64_t first_seed = 1;  ///< tuning: 1; report: from the hash of the commit
};

/// All trials of a study, nulls first.
std::vector<BlindTrial> all_trials(const TrialOptions& options);

/// One of three fixed designs of 16 layouts, by the trial's seed: random patterns over the strata, turned twins,
/// checkerboards, a second rate and a thinner twin; and homogeneous coupons of five mixtures, pulled with a curve at
/// both rates. Kind `power`: known effects of
/// given visibility. Kind `alike`: collinear causes (droplets that mix, rigid ink that spreads) on upright layouts
/// alone. Pairs cannot be distinguished: coupons at two rates, every fast one of the second batch; for those to be
/// resolved, the tests that the diagnosis orders are printed in a third batch. Kind `outside`: eight unmodelled causes;
/// `form`: five known effects in another functional form, whose family is the right name; `even`: unmodelled causes
/// that act on all turned, or all thin, specimens by one factor. Kind `distorted`: moduli that the machine shows by a
/// smooth law of their own size, on upright layouts alone. Kind `homogeneous`: tabulated moduli of blends at several
/// rates, under rate laws of three forms, blends off the mixture law, or nothing. Kind `loops`: coupons that are
/// unloaded on their way, at three rates: a phase that flows, relaxation in two forms, or nothing. Kind `machines`: the
/// same on two machines, of which one has a compliance or a gain of its own, or nothing; `spectrum`: of two materials
/// over seven decades, under three rate laws, or nothing; `warm`: at three temperatures that shift the rate, under two
/// rate laws, or nothing. Kind `fracture`: moduli and fracture tests of one of two designs of 24 layouts, whose
/// replicates are specimens, under effects that act on fracture, or nothing. Trials of one effect and size share a
/// truth, ten nulls do: each draws four of six specimens of a design.
std::vector<laboratory::Experiment> experiments_of(const BlindTrial& trial, const TrialOptions& options);

/// The truth of a trial's laboratory.
laboratory::Truth truth_of(const BlindTrial& trial, const TrialOptions& options);

/// Prints and measures a trial: FOLDER/set, and sealed next to it FOLDER/set.truth.toml with the visibility of the
/// hidden effects in these specimens (signal-to-noise ratio, nearest rival, chance that all rivals lose; of an
/// unmodelled cause the signal alone), computed before scatter is drawn.
void generate(const BlindTrial& trial, const TrialOptions& options, const std::filesystem::path& folder);

/// Adds the next experiments of FOLDER/diagnosis.json to FOLDER/set, as a third batch; the diagnosis that ordered them
/// goes to FOLDER/first_diagnosis.json. Coupons are pulled without unloading them on the way.
void print_what_was_ordered(const BlindTrial& trial, const TrialOptions& options, const std::filesystem::path& folder);

/// `nacre diagnose FOLDER/set` as a program of its own, result in FOLDER/diagnosis.json; fracture simulations are kept
/// in FOLDER/store, of kind `fracture` in a kept emulator of the design. Throws InputError when it fails.
void diagnose(const BlindTrial& trial, const TrialOptions& options, const std::filesystem::path& folder);

}  // namespace nacre::blind_trials
