#pragma once
// DIAGNOSE and DIAGNOSIS.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nacre/diagnose_request_t.hpp"
#include "nacre/diagnosis_t.hpp"
#include "pattern/design.hpp"
#include "tester/loading.hpp"
#include "wire/parts.hpp"

namespace nacre::wire {

/// A specimen as it counted when it was named.
struct NamedSpecimen {
  std::string name;
  int revision = 0;  ///< of its MEASUREMENT
  bool operator==(const NamedSpecimen&) const = default;
};

/// DIAGNOSE: the measurements meant, the calibrated parameters, and what was simulated in search of them.
struct DiagnoseRequest {
  using Wire = diagnose_request_t;
  int round = 0;
  tester::Fidelity fidelity = tester::Fidelity::full;
  material::ParameterSet parameters;
  std::vector<sysid::EvaluatedModel> evaluated;  ///< in that search
  std::vector<NamedSpecimen> specimens;          ///< sorted
  bool operator==(const DiagnoseRequest&) const = default;

  static void fields(auto& field, auto& m) {
    field("round", m.round, kRoundNumber);
    field("fidelity", m.fidelity);
    field("parameters", m.parameters);
    field.count("n_evaluated", m.evaluated);
    field("evaluated", m.evaluated);
    field.count("n_specimens", m.specimens);
    field.columns(m.specimens, [](auto& column, auto& specimen) {
      column("specimens", specimen.name);
      column("revision", specimen.revision, kCounted);
    });
  }
  std::string contradiction() const;
};

/// A named effect with one of its parameters; a further parameter of the effect is a further row.
struct DiagnosedEffect {
  std::string name;  ///< any: the validation agent reports an effect that it does not know, and the game goes on
  std::string family;
  double parameter = 0.0;
  double interval_low = 0.0, interval_high = 0.0;  ///< 90 %
  std::string unit;
  bool operator==(const DiagnosedEffect&) const = default;

  static void fields(auto& field, auto& m) {
    field("name", m.name, kName);
    field("family", m.family);
    field("parameter", m.parameter);
    field("interval_low", m.interval_low);
    field("interval_high", m.interval_high);
    field("unit", m.unit);
  }
};

/// The outcome of one candidate effect of the library.
struct DiagnosedCandidate {
  static constexpr std::string_view kStatuses[] = {"in_set", "excluded", "invisible", "not_simulated",
                                                   "not_applicable"};
  std::string name;
  std::string status;
  double statistic = 0.0;      ///< improvement of the joint refit
  double p_family_wise = 1.0;  ///< 1 when not tested
  double absorption = 0.0;     ///< share of its signature that base parameters can imitate
  bool operator==(const DiagnosedCandidate&) const = default;

  static void fields(auto& field, auto& m) {
    constexpr double kRounding = 1e-6;  // a difference of two norms
    field("name", m.name, kName);
    field("status", m.status, OneOf{kStatuses});
    field("statistic", m.statistic);
    field("p_family_wise", m.p_family_wise, Range{0.0, 1.0});
    field("absorption", m.absorption, Range{-kRounding, 1.0 + kRounding});
  }
};

/// What the named effects change on designs that no fit has seen.
struct DiagnosedGain {
  double held_out_error_before = 0.0, held_out_error_after = 0.0;
  double relative_reduction = 0.0;
  double reduction_low = 0.0, reduction_high = 0.0;  ///< 90 %
  bool operator==(const DiagnosedGain&) const = default;

  static void fields(auto& field, auto& m) {
    field("held_out_error_before", m.held_out_error_before);
    field("held_out_error_after", m.held_out_error_after);
    field("relative_reduction", m.relative_reduction);
    field("reduction_low", m.reduction_low);
    field("reduction_high", m.reduction_high);
  }
};

/// A test that would discriminate between rival causes.
struct NextExperiment {
  pattern::Design design;
  tester::TestKind test = tester::TestKind::modulus;
  tester::TestConditions conditions;
  int replicates = 1;
  tester::Loading loading = {};
  std::string reason;
  bool operator==(const NextExperiment&) const = default;

  static void fields(auto& field, auto& m) {
    field("design", m.design);
    field("test", m.test);
    field("conditions", m.conditions);
    field("replicates", m.replicates, Range{1, 1000});
    field("loading", m.loading);
    field("reason", m.reason);
  }
};

/// DIAGNOSIS: where the simulation is wrong, and which effect explains it.
struct Diagnosis {
  using Wire = diagnosis_t;
  static constexpr std::string_view kVerdicts[] = {"base_sufficient", "named", "ambiguous", "unexplained",
                                                   "insufficient"};
  int round = 0;
  std::string verdict;
  std::string summary;  ///< in words, for a person
  std::vector<DiagnosedEffect> effects;
  std::vector<DiagnosedCandidate> candidates;
  std::optional<DiagnosedGain> gain;
  std::vector<NextExperiment> next_experiments;
  bool operator==(const Diagnosis&) const = default;

  static void fields(auto& field, auto& m) {
    field("round", m.round, kRoundNumber);
    field("verdict", m.verdict, OneOf{kVerdicts});
    field("summary", m.summary);
    field.count("n_effects", m.effects);
    field("effects", m.effects);
    field.count("n_candidates", m.candidates);
    field("candidates", m.candidates);
    field.part("has_gain", "gain", m.gain);
    field.count("n_next_experiments", m.next_experiments);
    field("next_experiments", m.next_experiments);
  }
};

}  // namespace nacre::wire
