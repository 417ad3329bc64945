#pragma once
// The result of a diagnosis (docs/METHODS.md, "Diagnosis").

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/data_summary.hpp"
#include "diagnosis/features.hpp"
#include "diagnosis/material_constants.hpp"
#include "diagnosis/procedure.hpp"
#include "material/extensions.hpp"
#include "material/parameters.hpp"
#include "material/ranges.hpp"
#include "measurement/specimen_record.hpp"
#include "measurement/surroundings.hpp"
#include "pattern/design.hpp"
#include "tester/curve.hpp"
#include "tester/loading.hpp"

namespace nacre::diagnosis {

enum class Verdict {
  base_sufficient,  ///< residuals are noise
  named,            ///< one effect (or a pair that is needed together) explains the misfit
  ambiguous,        ///< several effects explain the misfit equally well
  unexplained,      ///< no known effect explains the misfit
  insufficient,     ///< too little was measured: no known cause would have shown
};
std::string_view to_string(Verdict verdict);

/// The step that decided a verdict.
enum class Reason {
  residuals_are_noise,  ///< base_sufficient
  no_effect_helps,      ///< unexplained: a misfit, and no effect improves the fit beyond chance
  residuals_stay,       ///< unexplained: larger than noise with one and two effects
  at_bound,             ///< unexplained: the nearest effect, whose residuals are noise, is at its bound
  weak_signal,          ///< unexplained: too little of the nearest effect's signature is its own
  contrast,             ///< unexplained: a contrast explains more than the nearest effect
  condition,            ///< unexplained: one factor on all specimens of a condition does as well
  discrepancy,          ///< unexplained: data of a discrepancy model favour an effect by as much too often
  worse_unseen,         ///< unexplained: the nearest effect predicts designs held out of the fit worse than the base
  one_effect,           ///< named or ambiguous: one explains the data
  two_effects,          ///< the same: none alone, two together
  other_material,       ///< ambiguous: the base, or an effect, explains the data with constants of another material
  factor,               ///< unexplained: free levels of factors explain the data, of which no effect is a law
  free_form,            ///< named: the data depend on the strain rate, and no law of it fits
  carried_part,         ///< named: one explains the part of the data that carries it; elsewhere residuals stay
  nothing_visible,      ///< insufficient: no effect of usual size would have been visible
  further_column,       ///< unexplained: only a column that no effect is about goes with the data
  room_is_left,         ///< insufficient: stiffness may change with a condition by more than matters
};

/// Why it was decided so.
struct Finding {
  Reason reason = Reason::residuals_are_noise;
  std::vector<std::string> nearest = {};  ///< from residuals_stay to worse_unseen, and other_material: the effects
                                          ///< that come nearest
  double value = 0.0;      ///< residuals_stay: share of chi squared that they take away; at_bound: size in the
                           ///< effect's unit; weak_signal: SNR; discrepancy: chance; free_form:
                           ///< chance of a misfit as large as that of the nearest law; carried_part: residuals of the
                           ///< feature that misfits most elsewhere, in standard deviations; room_is_left: largest
                           ///< change of stiffness
  double needed = 0.0;     ///< weak_signal, discrepancy: of a name
  std::string along = {};  ///< contrast, condition, further_column, room_is_left: which; carried_part: the feature that
                           ///< misfits most elsewhere
  std::vector<Feature> carriers = {};  ///< carried_part: features of the part
};

/// A fitted number with its 90 % interval, in the unit of the effect.
struct FittedNumber {
  double value = 0.0, interval_low = 0.0, interval_high = 0.0;
};

/// Whether the data tell a derived number: its interval is no wider than 1 or, of one with a unit, than its value.
bool is_told(const FittedNumber& number, const material::DerivedNumber& derived);

/// An effect that was named, with its size (its fitted parameter) and 90 % interval in the unit of the effect.
struct NamedEffect {
  std::string name;
  std::string family;
  double parameter = 0.0;
  double interval_low = 0.0, interval_high = 0.0;
  std::string unit;
  std::vector<FittedNumber> further = {};  ///< further parameters of the effect, in the order of material::Effect
  std::vector<FittedNumber> derived = {};  ///< Effect::derived, in its order (is_told())
  std::vector<std::string> each = {};      ///< Effect::one_for_each: what parameter and further ones are of
};

enum class CandidateStatus {
  in_set,          ///< explains the data
  excluded,        ///< would be seen, or was, and does not explain them
  invisible,       ///< these specimens would not show it
  not_simulated,   ///< acts on their fracture tests, of which no simulation shows it: too many are asked for
  not_applicable,  ///< acts on none of their tests
};
std::string_view to_string(CandidateStatus status);

/// Whether fits with and without the effect were compared.
inline bool was_weighed(CandidateStatus status) {
  return status != CandidateStatus::not_simulated && status != CandidateStatus::not_applicable;
}

/// One of the known effects, and how it fared.
struct CandidateEffect {
  std::string name;
  CandidateStatus status = CandidateStatus::not_applicable;
  double statistic = 0.0;      ///< drop of the weighted sum of squares when the effect is fitted jointly with the base
  double p_family_wise = 1.0;  ///< chance that the best of all candidates drops it as much when the base is true
  double absorption = 0.0;     ///< share of the effect's signature that the base parameters imitate, 0..1
  double signal_to_noise =
      0.0;                    ///< norm of the whitened signature after projection, at the fitted (else a typical) size
  double parameter = 0.0;     ///< fitted size
  double p_fit = 1.0;         ///< chance of a misfit as large when base and this effect are the truth
  std::string nearest_rival;  ///< the effect of largest collinearity beyond the base; empty: none acts
  double rival_cosine = 0.0;  ///< collinearity with it: cosine of the projected signatures, 0..1
  double distance = 0.0;      ///< signal_to_noise sqrt((1 - cosine) / 2): from 2.2 on the two are distinguished with
                              ///< 5 % error
  std::optional<double> smallest_seen;  ///< parameter from which on its signature would have been visible; none up to
                                        ///< 0.6 of its range
};

/// What a contrast compares: one feature of one kind of test, as a whole or against a descriptor of the specimens.
struct ContrastView {
  Feature feature = Feature::log_modulus;
  tester::TestKind test = tester::TestKind::modulus;
  std::string against;  ///< a descriptor, kPredictedLevel, or empty: the whole feature, or a row of no specimen
  std::optional<int> material = {};  ///< E of this material in layouts against coupons: index in kConstantMaterials
};
/// The base model's own prediction as the descriptor of a contrast.
inline constexpr std::string_view kPredictedLevel = "level";

/// A pre-declared direction in which residuals may line up.
struct Contrast {
  std::string name;
  ContrastView view;
  double statistic = 0.0;  ///< standard deviations, after projection off what the base can imitate
  double p_family_wise = 1.0;
};

/// Whether a designer would choose otherwise: pairs of layouts under one test and the same conditions whose measured
/// values differ by three standard errors, and how many of them each model puts in the measured order, every design
/// predicted by a fit without it.
struct Ranking {
  int pairs = 0;
  int before = 0, after = 0;  ///< in the measured order by the base, by the extended model
};

/// Mean absolute error of one feature on designs that were held out.
struct FeatureGain {
  Feature feature = Feature::log_modulus;
  double before = 0.0, after = 0.0;
  double noise = 0.0;    ///< the same of a perfect model: scatter and discretisation error alone
  Ranking ranking = {};  ///< of layouts by this feature
};

/// Cross-validated errors: mean absolute errors of log E and log T on patterns that were held out (of slopes and
/// stresses where only coupons show anything).
struct Gain {
  double held_out_error_before = 0.0;
  double held_out_error_after = 0.0;
  double relative_reduction = 0.0;
  double interval_low = 0.0, interval_high = 0.0;  ///< 90 %, bootstrap over patterns
  std::vector<FeatureGain> features;
  bool of_coupons = false;  ///< the named effects act on coupons alone, or there is nothing else
};

struct NextExperiment {
  pattern::Design design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::TestConditions conditions;
  int replicates = 3;
  tester::Loading loading = {};
  std::optional<double> hold_s = {};  ///< of a modulus that is left after a hold; the rate is that of such a pull
  measurement::Surroundings surroundings = {};
  std::vector<std::string> machines = {};  ///< two: each piece on both; none: not noted in the data
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
  double base = 0.0, extended = 0.0;  ///< with the discretisation error expected along the shared directions
  double standard_error = 0.0;        ///< replicates, discretisation error and emulator; not the discretisation error
                                      ///< that rows share, which the predictions contain
  std::vector<double> descriptors;    ///< of the group, in the order of Diagnosis::descriptors
};

/// Curves of one group: measured, and by both models.
struct GroupCurves {
  std::string design;
  tester::TestKind test = tester::TestKind::toughness;
  tester::TestConditions conditions;
  tester::Curve measured, base, extended;
};

/// What was refined.
enum class DiscretisationChange { half_time_step, half_rate, doubled_recording, half_element };

/// Change of one feature by one numerical choice: the largest of three specimens.
struct SanityCheck {
  DiscretisationChange changed = DiscretisationChange::half_element;
  Feature feature = Feature::log_modulus;
  double largest = 0.0;    ///< largest change over the specimens, in the feature's unit
  double allowed = 0.0;    ///< standard error of a group
  bool numerical = false;  ///< more than twice that: a misfit of this size may be discretisation error
};

/// Constants of a fit, of the kinds of specimens that were included.
struct FittedConstants {
  std::optional<material::ModulusParameters> modulus;      ///< moduli of layouts
  std::optional<material::ToughnessParameters> toughness;  ///< fracture tests
  std::optional<material::ModulusParameters> coupon;       ///< the bulk of homogeneous coupons
  material::Extensions extensions;
  bool operator==(const FittedConstants&) const = default;
};

/// The most specific property that several models share.
struct CommonGround {
  enum class Kind { nothing, effect, family, material_side, measurement_side };
  Kind kind = Kind::nothing;
  std::string name = {};  ///< of the effect or family
};

/// Rows that are judged together.
struct RowsOf {
  enum class Kind { none, constants, moduli, notched, coupons };
  Kind kind = Kind::none;
  std::string material = {};  ///< of coupons; empty: all of them
  bool operator==(const RowsOf&) const = default;
};

/// What limits the worth of a verdict.
struct Cautions {
  std::vector<OtherMaterial> other_materials;  ///< that are none of the inks
  std::vector<ModulusAtBound> at_bounds;       ///< of the model that was decided for
  std::vector<std::string> out_of_line;        ///< groups whose replicates do not agree: "modulus of LAYOUT"
  std::vector<tester::TestKind> unreplicated;  ///< tests without replicates: a scatter is assumed
  bool nothing_replicated = false;             ///< no test has any
  bool replicates_are_equal = false;           ///< as no printed specimens are
  std::vector<std::string> alike;              ///< conditions that go with that of the strongest contrast
  std::vector<std::string> rival_laws;         ///< of a condition: these data cannot part them
  bool machines_not_compared = false;          ///< they matter, and no piece and no batch was tested on both of two
  int disconnected_batches = 0;                ///< sets of batches without a common design; 0: no batches
};

struct Diagnosis {
  Verdict verdict = Verdict::base_sufficient;
  Finding finding;
  std::string summary;               ///< for a person, a few sentences: summary_of(), and what callers add
  std::vector<NamedEffect> effects;  ///< one or two when named, else empty
  std::vector<std::vector<std::string>>
      possible;                                   ///< models that stay possible, the best first: names of their effects
  CommonGround common_ground;                     ///< of all possible models
  std::vector<ModulusAtBound> untold;             ///< with Reason::other_material: where specimens of these would tell
  std::vector<std::string> machines;              ///< names of those that specimens were tested on
  std::vector<std::vector<std::string>> factors;  ///< least sets of conditions whose free levels make the base fit
  std::vector<CandidateEffect> candidates;        ///< of all known effects, in the order of material::effect_library();
                                                  ///< behind them named laws of conditions
  std::vector<Contrast> contrasts;                ///< strongest first
  RowsOf loudest;                                 ///< whose residuals are largest against their noise
  std::optional<Gain> gain;                       ///< of the named model
  std::optional<Gain> partial_gain;               ///< of the effect that comes nearest, when unexplained
  std::vector<NextExperiment> next_experiments;
  double p_misfit = 1.0;           ///< omnibus: chance of a base misfit as large
  double p_outside = 1.0;          ///< chance that an unmodelled cause would give a name as surely; 1 when no name was
                                   ///< in question
  double replicate_sd = 0.0;       ///< pooled standard deviation of log E, else of log T, else of a coupon's stress
  double discretisation_sd = 0.0;  ///< discretisation error of log E: independent part, per layout
  double discretisation_shared_sd =
      0.0;                  ///< and along the directions that all layouts share, root mean square over these
  bool noise_known = true;  ///< false: that test has no replicates, replicate_sd is assumed
  FittedConstants base_fit;
  FittedConstants extended_fit;  ///< of the named effects, else of the best that stays possible or comes nearest
  std::vector<ResidualRow> residuals;
  std::vector<SanityCheck> sanity;       ///< sensitivity to the discretisation
  std::vector<std::string> descriptors;  ///< names of the quantities that residuals are shown against
  std::vector<GroupCurves> curves;       ///< of fracture tests and coupons
  Cautions cautions;
  DataSummary data;                             ///< what the set shows by itself
  double contrast_level = Levels{}.contrast;    ///< chance below which residuals line up with a contrast
  double assumed_sd = NoiseRules{}.assumed_sd;  ///< scatter where there are no replicates
  int simulations = 0;                          ///< of fracture tests, really done
  std::string procedure;  ///< hash of effects, features, contrasts, thresholds, discretisation floor and fidelity: two
                          ///< diagnoses with the same one followed the same procedure
};

/// Whether the base's residuals line up with their strongest contrast beyond chance.
bool lines_up(const Diagnosis& diagnosis);

/// The result where nothing can be computed: `insufficient`, nothing claimed, and why.
Diagnosis insufficient(const std::string& why);

}  // namespace nacre::diagnosis
