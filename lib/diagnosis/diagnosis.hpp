#pragma once
// What a diagnosis answers (docs/METHODS.md, "Diagnosis"), and how to ask for one.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "diagnosis/features.hpp"
#include "diagnosis/fracture_discretisation.hpp"
#include "diagnosis/modulus_floor.hpp"
#include "material/ranges.hpp"
#include "measurement/specimen_record.hpp"
#include "tester/loading.hpp"

namespace nacre::diagnosis {

enum class Verdict {
  base_sufficient,  ///< nothing is wrong beyond noise
  named,            ///< one effect (or a pair that is needed together) explains the misfit
  ambiguous,        ///< something is wrong and several effects explain it equally well
  unexplained,      ///< something is wrong that no effect of the library explains
};
std::string_view to_string(Verdict verdict);

/// A fitted number with its 90 % interval, in the unit of the effect library.
struct FittedNumber {
  double value = 0.0, interval_low = 0.0, interval_high = 0.0;
};

/// An effect that was named, with its fitted parameter and 90 % interval in the unit of the effect library.
struct NamedEffect {
  std::string name;
  std::string family;
  double parameter = 0.0;
  double interval_low = 0.0, interval_high = 0.0;
  std::string unit;
  std::vector<FittedNumber> further = {};  ///< what an effect takes beside its parameter, in the order of the library
};

/// What became of one effect of the library.
struct CandidateEffect {
  std::string name;
  std::string status;          ///< in_set, excluded, invisible, not_applicable
  double statistic = 0.0;      ///< drop of the weighted sum of squares when the effect is fitted jointly with the base
  double p_family_wise = 1.0;  ///< chance that the best of all candidates drops it as much when the base is true
  double absorption = 0.0;     ///< share of the effect's signature that the base parameters imitate, 0..1
  double signal_to_noise =
      0.0;                 ///< norm of the whitened signature after projection, at the fitted (else a typical) size
  double parameter = 0.0;  ///< fitted size
  double p_fit = 1.0;      ///< chance of a misfit as large when base and this effect are the truth
  std::string
      nearest_rival;  ///< the effect whose signature is most like this one's beyond the base; empty: none is seen
  double rival_cosine = 0.0;  ///< how like, 0..1
  double distance = 0.0;  ///< signal_to_noise sqrt((1 - cosine) / 2): from 2.2 on the two are told apart with 5 % error
  std::optional<double> smallest_seen;  ///< parameter from which on its traces would have shown; none up to 0.6 of its
                                        ///< range
};

/// What a contrast looks at: one feature of one kind of test, as a whole or against something of the specimens.
struct ContrastView {
  Feature feature = Feature::log_modulus;
  tester::TestKind test = tester::TestKind::modulus;
  std::string against;  ///< a descriptor, kPredictedLevel, or empty: the whole feature, or a row of history
};
/// The base model's own prediction as what a contrast looks along.
inline constexpr std::string_view kPredictedLevel = "level";

/// A pre-declared direction in which residuals may line up.
struct Contrast {
  std::string name;
  ContrastView view;
  double statistic = 0.0;  ///< standard deviations, after projection off what the base can imitate
  double p_family_wise = 1.0;
};

/// Whether a designer would choose otherwise: pairs of layouts under one test and the same conditions that the
/// measurements set apart (by three standard errors), and how many of them each model puts in the measured order,
/// every design foretold by a fit without it.
struct Ranking {
  int pairs = 0;
  int before = 0, after = 0;  ///< in the measured order by the base, by the extended model
};

/// Mean absolute error of one feature on designs that were held out.
struct FeatureGain {
  Feature feature = Feature::log_modulus;
  double before = 0.0, after = 0.0;
  double noise = 0.0;    ///< what scatter and numerics alone would leave
  Ranking ranking = {};  ///< of layouts by this feature
};

/// Errors are mean absolute errors of log E and log T on patterns that were held out (of slopes and stresses where only
/// coupons show anything).
struct Gain {
  double held_out_error_before = 0.0;
  double held_out_error_after = 0.0;
  double relative_reduction = 0.0;
  double interval_low = 0.0, interval_high = 0.0;  ///< 90 %, bootstrap over patterns
  std::vector<FeatureGain> features;
  bool of_coupons = false;  ///< what is named acts on coupons alone, or there is nothing else
};
/// What a named effect does for designs that the fit has not seen, in a sentence: errors as per cent of E and T, and a
/// gain (or a loss) only where the 90 % interval leaves no doubt of its sign. A cause may be sure and its gain not: the
/// base imitates most of it there.
std::string gain_in_words(const Gain& gain);
/// Whether the choice of designs changes, in a sentence for each of E and T; empty where no two designs were set apart.
std::string choice_in_words(const Gain& gain);

struct NextExperiment {
  pattern::Design design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::TestConditions conditions;
  int replicates = 3;
  tester::Loading loading = {};
  std::string reason;
};

/// One feature of one group of specimens as the report shows it.
struct ResidualRow {
  std::string design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::TestConditions conditions;
  Feature feature = Feature::log_modulus;
  int group = 0;
  double measured = 0.0;              ///< in the feature's own unit: logarithms of Pa, strains
  double base = 0.0, extended = 0.0;  ///< with what numerics are found to leave along the shared directions
  double standard_error =
      0.0;  ///< replicates, numerics and emulator, but for what numerics share among rows: the predictions hold that
  std::vector<double> descriptors;  ///< of the group, in the order of Diagnosis::descriptors
};

/// Curves of one group: measured, and by both models.
struct GroupCurves {
  std::string design;
  tester::TestKind test = tester::TestKind::toughness;
  tester::TestConditions conditions;
  tester::Curve measured, base, extended;
};

/// What one numerical choice changes in one feature: the largest of three specimens.
struct SanityCheck {
  std::string
      changed;  ///< "half the time step", "half the simulated rate", "doubled recording", "half the element size"
  Feature feature = Feature::log_modulus;
  double largest = 0.0;    ///< largest change over the specimens, in the feature's unit
  double allowed = 0.0;    ///< standard error of a group: what such a change would hide in
  bool numerical = false;  ///< more than twice that: a misfit of this size is not to be called physics
};

/// Constants of a fit, of those kinds of specimens that took part.
struct FittedConstants {
  std::optional<material::ModulusParameters> modulus;      ///< moduli of layouts
  std::optional<material::ToughnessParameters> toughness;  ///< fracture tests
  std::optional<material::ModulusParameters> coupon;       ///< the bulk of homogeneous coupons
  material::Extensions extensions;
  bool operator==(const FittedConstants&) const = default;
};

struct Diagnosis {
  Verdict verdict = Verdict::base_sufficient;
  std::string summary;               ///< for a person, a few sentences
  std::vector<NamedEffect> effects;  ///< one or two when named, else empty
  std::vector<std::vector<std::string>>
      possible;               ///< models that stay possible, the best first: names of their effects
  std::string common_ground;  ///< what the possible models share: "effect interface_anisotropy", "family geometry",
                              ///< "measurement side"; empty: nothing
  std::vector<CandidateEffect> candidates;  ///< in the order of the library
  std::vector<Contrast> contrasts;          ///< strongest first
  std::string loudest;               ///< specimens whose residuals are largest against their noise: "soft coupons"
  std::optional<Gain> gain;          ///< of the named model
  std::optional<Gain> partial_gain;  ///< of what comes nearest, when unexplained
  std::vector<NextExperiment> next_experiments;
  double p_misfit = 1.0;  ///< omnibus: chance of a base misfit as large
  double p_outside =
      1.0;  ///< chance that a cause outside the library would lead to a name as surely; 1 when no name was in question
  double replicate_sd = 0.0;       ///< pooled standard deviation of log E, else of log T, else of a coupon's stress
  double discretisation_sd = 0.0;  ///< what numerics leave of log E: independent part, per layout
  double discretisation_shared_sd =
      0.0;                  ///< and along the directions that all layouts share, root mean square over these
  bool noise_known = true;  ///< false: that test has no replicates, replicate_sd is assumed
  FittedConstants base_fit;
  FittedConstants extended_fit;  ///< of what is named, else of the best that stays possible or comes nearest
  std::vector<ResidualRow> residuals;
  std::vector<SanityCheck> sanity;       ///< what other numerics change, before anything is called physics
  std::vector<std::string> descriptors;  ///< names of what residuals are shown against
  std::vector<GroupCurves> curves;       ///< of fracture tests and coupons
  int simulations = 0;                   ///< of fracture tests, really done
  std::string procedure;  ///< hash of library, features, contrasts, thresholds, numerics floor and fidelity: two
                          ///< diagnoses with the same one asked the same
};

struct DiagnosisSettings {
  material::ParameterSet start;                                  ///< where the base fit begins
  material::ParameterRanges ranges = material::thesis_ranges();  ///< moduli and ratios may leave them: CoordinateMap
  tester::Fidelity fidelity = tester::Fidelity::full;
  int bootstraps = 2000;  ///< at least 2 / name_level: fewer could never reach the level
  std::uint64_t seed = 1;
  ModulusFloor floor;                              ///< from data/discretisation_floor.toml
  FractureDiscretisation fracture_discretisation;  ///< from the same file
  int search_budget = 40;            ///< evaluations of the fracture tests in search of a base fit; 0: begin at `start`
  std::filesystem::path store;       ///< file that keeps fracture simulations; empty: none
  int threads = 0;                   ///< 0 all allowed cores
  bool check_discretisation = true;  ///< simulate three specimens with other numerics too
  double name_level = 0.003;         ///< family-wise level of a name
  double unexplained_level = 0.01;   ///< level of a misfit without a name
  /// Called now and then with the share of the work done (0..1) and what is being done.
  std::function<void(double, std::string_view)> progress = {};
};

/// Specimens that are too few for any statement: the answer is undecided().
class TooFewSpecimens : public InputError {
  using InputError::InputError;
};

/// Diagnoses a set of specimens: moduli and fracture tests of layouts, coupons with curves. Throws TooFewSpecimens when
/// fewer than eight groups of layouts have a valid test and fewer than four coupons, that differ in material, rate or
/// thickness (replicates count once), a curve; InputError when there are too few bootstraps for the level of a name.
Diagnosis diagnose(const std::vector<measurement::SpecimenRecord>& specimens, const DiagnosisSettings& settings);

/// Whether what the base leaves lines up with its strongest contrast beyond chance.
bool lines_up(const Diagnosis& diagnosis);

/// What is said where nothing can be computed: `ambiguous`, nothing claimed, and why.
Diagnosis undecided(const std::string& why);

/// The JSON document of `nacre diagnose --json`.
std::string to_json(const Diagnosis& diagnosis);

}  // namespace nacre::diagnosis
