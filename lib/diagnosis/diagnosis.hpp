#pragma once
// What a diagnosis answers (docs/METHODS.md, "Diagnosis"), and how to ask for one.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/modulus_floor.hpp"
#include "material/parameters.hpp"
#include "measurement/measurement.hpp"
#include "tester/tester.hpp"

namespace nacre::diagnosis {

enum class Verdict {
  base_sufficient,  ///< nothing is wrong beyond noise
  named,            ///< one effect (or a pair that is needed together) explains the misfit
  ambiguous,        ///< something is wrong and several effects explain it equally well
  unexplained,      ///< something is wrong that no effect of the library explains
};
std::string_view to_string(Verdict verdict);

/// An effect that was named, with its fitted parameter and 90 % interval in the unit of the effect library.
struct NamedEffect {
  std::string name;
  std::string family;
  double parameter = 0.0;
  double interval_low = 0.0, interval_high = 0.0;
  std::string unit;
};

/// What became of one effect of the library.
struct Candidate {
  std::string name;
  std::string status;          ///< in_set, excluded, invisible, not_applicable
  double statistic = 0.0;      ///< drop of the weighted sum of squares when the effect is fitted jointly with the base
  double p_family_wise = 1.0;  ///< chance that the best of all candidates drops it as much when the base is true
  double absorption = 0.0;     ///< share of the effect's signature that the base parameters imitate, 0..1
  double signal_to_noise = 0.0;  ///< norm of the whitened signature after projection, at the fitted (else a typical) size
  double parameter = 0.0;      ///< fitted size
  double p_fit = 1.0;          ///< chance of a misfit as large when base and this effect are the truth
};

/// A pre-declared direction in which residuals may line up.
struct Contrast {
  std::string name;
  double statistic = 0.0;  ///< standard deviations, after projection off what the base can imitate
  double p_family_wise = 1.0;
};

/// Errors are mean absolute errors of log E on patterns that were held out.
struct Gain {
  double held_out_error_before = 0.0;
  double held_out_error_after = 0.0;
  double relative_reduction = 0.0;
  double interval_low = 0.0, interval_high = 0.0;  ///< 90 %, bootstrap over patterns
};

struct NextExperiment {
  pattern::Design design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::TestConditions conditions;
  int replicates = 3;
  std::string reason;
};

/// One specimen group as the report shows it.
struct ResidualRow {
  std::string design;
  double orientation_deg = 0.0;
  double measured_pa = 0.0;
  double base_pa = 0.0, extended_pa = 0.0;  ///< with what numerics are found to leave along the shared directions
  double standard_error = 0.0;  ///< of log E, replicates and numerics together
};

struct Diagnosis {
  Verdict verdict = Verdict::base_sufficient;
  std::string summary;                ///< for a person, a few sentences
  std::vector<NamedEffect> effects;   ///< one or two when named, else empty
  std::vector<Candidate> candidates;  ///< in the order of the library
  std::vector<Contrast> contrasts;    ///< strongest first
  std::optional<Gain> gain;           ///< of the named model
  std::vector<NextExperiment> next_experiments;
  double p_misfit = 1.0;              ///< omnibus: chance of a base misfit as large
  double replicate_sd = 0.0;          ///< pooled standard deviation of log E
  double numerics_sd = 0.0;           ///< what numerics leave of log E: independent part, per layout
  double numerics_shared_sd = 0.0;    ///< and along the directions that all layouts share, root mean square over groups
  bool noise_known = true;            ///< false: no replicates, relative statements only
  material::ModulusParameters base_fit;
  material::ParameterSet extended_fit;  ///< base parameters and extension of the named model; base fit otherwise
  std::vector<ResidualRow> residuals;
};

struct DiagnosisSettings {
  material::ParameterSet start;  ///< where the base fit begins
  tester::Fidelity fidelity = tester::Fidelity::full;
  int bootstraps = 2000;             ///< at least 2 / name_level: fewer could never reach the level
  std::uint64_t seed = 1;
  ModulusFloor floor;                ///< from data/numerics_floor.toml
  double name_level = 0.003;         ///< family-wise level of a name
  double unexplained_level = 0.01;   ///< level of a misfit without a name
  /// Called now and then with the share of the work done (0..1) and what is being done.
  std::function<void(double, std::string_view)> progress = {};
};

/// Diagnoses the modulus side of a set of specimens. Throws InputError when fewer than eight groups of specimens have a valid
/// modulus (six base parameters are refitted), or when there are too few bootstraps for the level of a name.
Diagnosis diagnose_modulus(const std::vector<measurement::SpecimenRecord>& specimens, const DiagnosisSettings& settings);

/// The JSON document of `nacre diagnose --json`.
std::string to_json(const Diagnosis& diagnosis);

}  // namespace nacre::diagnosis
