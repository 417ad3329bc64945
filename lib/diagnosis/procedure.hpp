#pragma once
// The procedure of a diagnosis: every number that decides something, by subject, each with its meaning and the place
// where it was measured or decided (decisions: docs/decisions; docs/METHODS.md, "Diagnosis"). Numbers without a place
// were set by judgement. Passed by value; hashed whole, so that two diagnoses with equal hashes asked the same.
//
// Beside them stand in the sources: definitions (of a feature, a descriptor, an effect), and what only serves
// computing (finite differences, guards against division by zero).

#include <array>
#include <string>

namespace nacre::diagnosis {

struct DiagnosisSettings;

/// How curves become numbers.
struct CurveReading {
  int fracture_points = 128;     ///< at which a fracture curve is taken first, measured and simulated alike
  double drop_offset = 0.05;     ///< added to the fall after the peak before its logarithm is taken
  double carried_share = 0.8;    ///< of its largest stress: a coupon that carries less is parting
  double turned_share = 0.8;     ///< of the stress where strain turns: an unloading that falls less far has no slope
  double parted_share = 0.05;    ///< of the same: what falls below it between two readings has broken
  int fewest_readings = 128;     ///< a curve of fewer is not smoothed
  double fewest_pieces = 8.0;    ///< of a smoothed curve
  double most_pieces = 64.0;     ///< of a smoothed curve
  double fewest_per_knot = 4.0;  ///< readings behind a knot of it, on average
  double quiet_scatter = 1e-4;   ///< of readings, over the largest stress: below it a curve is not smoothed
  double knot_scatter = 3e-3;    ///< wanted of a knot, over the largest stress
  static constexpr void fields(auto& field, auto& m);
};

/// The noise of rows.
struct NoiseRules {
  double assumed_sd = 0.02;        ///< of single specimens without replicates, relative
  double assumed_toe = 0.02;       ///< the same of a toe: this strain times assumed_sd
  int enough_dof = 8;              ///< replicates that agree too well are filled up to so many with assumed_sd
  int own_dof = 5;                 ///< from which on coupons of one material scatter by their own replicates
  double least_modulus_sd = 1e-4;  ///< no replicates of moduli agree better: a testing machine's last digit
  double least_curve_sd = 2e-3;    ///< nor features of curves: a fifth of class 1 of ISO 7500-1 and ISO 9513
  double least_strain_sd = 2e-5;   ///< nor toes, as a strain
  double stresses_together = 0.9;  ///< assumed correlation of the stresses of one specimen
  int dof_per_batch = 4;           ///< means of batches come off where so many degrees of freedom a batch are left
  int fewest_for_history = 6;      ///< specimens behind a change over batches or print order
  double constant_sd = 0.11;       ///< of log(E in layouts / E of its own specimens): +-20 % of Table A.2 as 90 %
  double crack_scatter_sd = 0.25;  ///< of the log of how much cracks scatter: half elements change it by -0.14 on the
                                   ///< mean over the twelve sets of docs/studies/discretisation-floor.md, with sd 0.21
  double piece_sd = 0.1;           ///< between pieces that were each tested under several conditions, none replicated
  double unlike_scatter = 0.01;    ///< chance below which materials of modulus tests scatter by their own replicates
  int assumed_worth = 4;           ///< degrees of freedom that an assumed scatter is worth: it may be twice as large
  double exponent_sd = 0.05;       ///< of a free exponent of the rate where no material has two; polymers have 0 to 0.5
  double level_sd = 100.0;         ///< of a free level, log units: so wide that the data alone decide
  static constexpr void fields(auto& field, auto& m);
};

/// Base constants as coordinates of a fit.
struct ConstantRules {
  double widening = 3.0;        ///< of the ranges of theta and the bulk constants about their middle
  double other_material = 2.0;  ///< the same: beyond it own specimens are of another material, with ranges about them
  double least_ratio = 0.02;    ///< Poisson's, and
  double most_ratio = 0.495;    ///< the largest
  double prior_sd = 0.5;        ///< of theta and bulk constants about the middle, in widths of the widened range
  double eta_reach = 1.5;       ///< eta is searched so far from the centre, in log units: the emulator knows no more
  double eta_sd = 0.7;          ///< of its prior, in log units
  double start_margin = 0.02;   ///< of an initial guess from its bounds, in coordinates
  double at_bound = 1e-3;       ///< a constant as near to its bound is at it, in coordinates
  static constexpr void fields(auto& field, auto& m);
};

/// Fracture tests: runs around a fit, and the emulator that learns from them (docs/decisions/0004).
struct EmulatorRules {
  int pairs = 14;                                               ///< opposite runs about the centre
  double spread = 0.3;                                          ///< of these, in log units of every constant
  std::array<double, 2> effect_sizes{0.2, 0.5};                 ///< at which effects are run, as shares of their range
  double jitter = 0.15;                                         ///< of eta meanwhile, in log units
  std::array<int, 4> models_in_turn{9, 25, 41, 61};             ///< base models of an emulator on a budget, in all
  int near_pairs = 1;                                           ///< about the first fit of these
  std::array<double, 4> sizes_in_turn{0.35, -0.35, 0.15, 0.6};  ///< of its effects, beside them
  int kept_pairs = 100;                                         ///< of a kept emulator: opposite runs about the centre
  double kept_spread = 0.4;                                     ///< of these
  std::array<double, 4> kept_sizes{0.1, 0.2, 0.35, 0.5};        ///< of its effects
  double kept_jitter = 0.3;                                     ///< of eta meanwhile
  int components = 2;                                           ///< of a feature over the groups, their mean among them
  int runs_of_component = 4;                                    ///< of the base model, at least, for each of these
  double level_sd = 3.0;                                        ///< of a feature's level, in its spread over runs
  double curved_length = 1.0;                                   ///< of the curved part, in log units of eta
  double effect_length = 0.5;                                   ///< of an effect's part, as a share of its range
  std::array<double, 5> own_shares{0.05, 0.2, 0.4, 0.65, 0.9};  ///< of an effect's variance that depends on eta: tried
  double no_effect = 1e-3;                                      ///< share of its range below which an effect is none
  double least_amplitude = 0.3;                                 ///< of an effect's part, in deviations of the noise
  std::array<double, 3> kernel{0.0, -1.0, -1.5};  ///< prior of the logarithms of linear part, curved part and noise
  double kernel_sd = 1.5;                         ///< of that prior
  int nearest = 5;                                ///< runs whose curves stand for a fit's behind the machine
  int refinements = 3;                            ///< how often fits are simulated and learnt from
  int refined_effects = 4;                        ///< of the best effects, beside the base
  double well_known = 1.5;                        ///< error of the emulator at a fit, in its own, that needs no more
  int refined_layouts = 24;                       ///< that are broken on half elements too, of most different stiffness
  int refined_specimens = 4;                      ///< of each
  double floor_log_sd = 1.1;  ///< of a variance in the table of discretisation errors, for one set of constants: the
                              ///< two of docs/studies/discretisation-floor.md differ by up to a factor of nine
  int floor_worth = 10;       ///< layouts that the correlations in the table are worth
  static constexpr void fields(auto& field, auto& m);
};

/// Fits of base and effects.
struct FitRules {
  int iterations = 12;      ///< of Levenberg-Marquardt, at most
  double converged = 0.02;  ///< a drop of chi squared that no threshold would notice, of a fit whose residuals are
                            ///< noise; of one that misfits as many times more
  std::array<double, 4> sizes{0.03, 0.1, 0.3, 0.6};    ///< of signatures, as shares of an effect's range
  int typical = 2;                                     ///< index of the size at which visibility is judged
  std::array<double, 2> probes{0.1, 0.6};              ///< sizes at which an effect acts on some row, or never
  double far_behind = 60.0;                            ///< in chi squared: no draw lets a rival catch up
  std::array<double, 3> restart_sizes{0.3, 0.6, 0.9};  ///< of an effect of the machine, tried at the centre
  double nothing = 0.01;                               ///< size that is none, as a share of the range
  double better = 1.0;    ///< drop of chi squared that is worth a further descent, or judging anew
  double noise_sd = 1.0;  ///< of chi squared above the rows: noise explains a fit below it, no further descent
  int mesh_passes = 2;    ///< fits with shared directions of the discretisation error
  static constexpr void fields(auto& field, auto& m);
};

/// Chances below which something is said.
struct Levels {
  double name = 0.003;        ///< family-wise, of a name
  double unexplained = 0.01;  ///< of a misfit without a name
  double exclusion = 0.005;   ///< of a rival's lead: it leaves the set (decision 13)
  double discrepancy = 0.03;  ///< of a name from the discrepancy model: the aim for unmodelled causes (decision 13)
  double contrast = 0.05;     ///< family-wise, of the strongest contrast: residuals line up with it
  double matters = 0.25;      ///< change of stiffness with a condition: no base is sufficient that leaves room for it
  static constexpr void fields(auto& field, auto& m);
};

/// What an effect must show before it is named.
struct NameRules {
  double visible_signal = 3.8;     ///< SNR from which an effect differs from none with 5 % error (decision 19)
  double distinct = 2.2;           ///< distance from which two effects differ with 5 % error
  double left_by_collinear = 0.6;  ///< of the SNR beside a collinear effect: sqrt(1 - 0.8^2), rho up to 0.76 was seen
  double lead = 10.6;              ///< in -2 log likelihood, a Bayes factor of 200: a rival drawn out leaves
  double certain_lead = 3.0;       ///< times `lead`: any rival leaves, even at 1.7 times the scatter (decision 17)
  double contrast_tie = 2.0;       ///< chi squared by which a contrast may explain more than the effect (decision 22)
  double even_lead = 7.6;          ///< over one factor on turned or thin specimens: 0.3 % by chance (decision 22)
  double imitated = 0.1;           ///< share of a direction beyond the model below which it is no contrast
  std::array<double, 4> powers{0.5, 1.5, 2.0, 3.0};  ///< of smooth laws of the stiffness that an effect must beat
  int pair_anchors = 3;                              ///< best single effects that pairs are built on (decision 22)
  double pair_share = 0.5;                           ///< of what the best one explains: an anchor explains as much
  std::array<double, 16> amplitudes{0.0, 0.25, 0.35, 0.5, 0.7,  1.0,  1.4,  2.0,
                                    2.8, 4.0,  5.6,  8.0, 11.0, 16.0, 23.0, 32.0};  ///< tried of a discrepancy, in sd
  double carried = 0.3;          ///< share of an effect's largest signal of a feature from which a feature carries it
  double along_contrasts = 0.5;  ///< of a discrepancy's variance, the rest is each design's own
  int discrepancy_draws = 1000;  ///< at most
  /// SNR below which no name is given: the rest beside a collinear effect would not be visible.
  double nameable_signal() const { return visible_signal / left_by_collinear; }
  static constexpr void fields(auto& field, auto& m);
};

/// Effect sizes by profile likelihood.
struct SizeRules {
  std::array<double, 4> shares{1.2, 1.45, 0.83, 0.67};  ///< of the fitted size, tried first
  double of_interest = 8.0;  ///< in deviance behind the best: sizes farther off do not matter
  double step = 2.5;         ///< in deviance: between sizes that differ by more one is tried
  double caught = 30.0;      ///< in deviance behind the best: caught in a local minimum
  int rounds = 4;            ///< of further sizes
  double beyond = 1.6;       ///< factor from the last size of interest to the next
  static constexpr void fields(auto& field, auto& m);
};

/// Gains on designs that were held out.
struct GainRules {
  int folds = 5;
  int interval_draws = 2000;  ///< bootstraps over designs
  double set_apart = 3.0;     ///< standard errors by which two designs differ measurably
  double law_share = 0.8;     ///< of the held-out error that free levels of a condition take away, for a law of it
  static constexpr void fields(auto& field, auto& m);
};

/// Next tests and plans.
struct TestRules {
  int count = 4;                  ///< next tests that are proposed
  int replicates = 3;             ///< of each
  double second_rate = 10.0;      ///< over the usual one
  double second_thickness = 0.5;  ///< over the usual one
  int condition_twins = 3;        ///< designs of a test that are also tested under other conditions
  std::array<double, 3> holds_s{30.0, 600.0, 7200.0};  ///< of relaxation and coupons with pauses: a coffee, an hour
                                                       ///< with its mounting, an afternoon
  double far_apart = 100.0;    ///< ratio of measured rates between which another is worth a test
  double most_errors = 4.0;    ///< standard errors believed of one way of testing: predictions are no better
  double least_errors = 1.0;   ///< below which a test separates nothing
  double least_fall = 1e-6;    ///< of a chance of confusion, below which no further test is bought for it
  double same_errors = 0.5;    ///< between two predicted changes: the test is a further replicate
  int broken_specimens = 4;    ///< behind the prediction of a fracture test
  int bundle = 3;              ///< twins that a plan adds together
  double worth_telling = 1.5;  ///< factor by which an addition lowers the smallest size told apart
  std::array<double, 9> planned_sizes{0.03, 0.05, 0.1,  0.15, 0.2,
                                      0.25, 0.3,  0.45, 0.6};  ///< closer than FitRules::sizes:
                                                               ///< flow begins at once
  int planned_typical = 6;                                     ///< index of the typical size of a diagnosis
  static constexpr void fields(auto& field, auto& m);
};

/// What a report warns of.
struct CautionRules {
  double numerical = 2.0;          ///< times a row's noise: a change by a discretisation that is larger matters
  double equal_replicates = 5e-4;  ///< scatter below which replicates were one number typed in for each
  static constexpr void fields(auto& field, auto& m);
};

struct Procedure {
  CurveReading curves;
  NoiseRules noise;
  ConstantRules constants;
  EmulatorRules emulator;
  FitRules fit;
  Levels levels;
  NameRules names;
  SizeRules sizes;
  GainRules gain;
  TestRules tests;
  CautionRules cautions;
  static constexpr void fields(auto& field, auto& m);
};

/// Content hash of how a verdict is reached, 16 hex digits: the procedure whole, known effects with their ranges,
/// features, descriptors, discretisation floor, fidelity, number of bootstraps. Not in it: the data, the initial guess
/// of the fit, the seed, and the budget of the search.
std::string procedure_hash(const DiagnosisSettings& settings);

}  // namespace nacre::diagnosis
