#pragma once
// The diagnosis of a round.

#include <optional>
#include <string>
#include <vector>

#include "dashboard/json_parts.hpp"
#include "run/run_record.hpp"

namespace nacre::dashboard {

/// Of the library; empty for an effect that it does not know.
std::string family_of_effect(const std::string& effect);
std::string explanation_of_effect(const std::string& effect);

struct EffectRow {
  static constexpr std::string_view kPageName = "Effect";
  wire::DiagnosedEffect effect;

  static void fields(auto& field, auto& m) {
    wire::DiagnosedEffect::fields(field, m.effect);
    field("explanation", explanation_of_effect(m.effect.name));
  }
};

struct CandidateRow {
  static constexpr std::string_view kPageName = "CandidateEffect";
  const wire::DiagnosedCandidate* candidate = &nothing<wire::DiagnosedCandidate>();

  static void fields(auto& field, auto& m) {
    wire::DiagnosedCandidate::fields(field, *m.candidate);
    field("family", family_of_effect(m.candidate->name));
    field("explanation", explanation_of_effect(m.candidate->name));
  }
};

struct ExperimentRow {
  static constexpr std::string_view kPageName = "Experiment";
  const wire::NextExperiment* experiment = &nothing<wire::NextExperiment>();

  static void fields(auto& field, auto& m) {
    const wire::NextExperiment& e = *m.experiment;
    field("design", e.design);
    field("test", e.test);
    condition_fields(field, e.conditions);
    field("replicates", e.replicates);
    field("loading", e.loading);
    field("reason", e.reason);
  }
};

struct DiagnosisRow {
  static constexpr std::string_view kPageName = "Diagnosis";
  std::string against;  ///< where the calibration of the round contradicts the verdict; empty: nowhere
  const wire::Diagnosis* diagnosis = &nothing<wire::Diagnosis>();
  std::vector<EffectRow> effects;

  static void fields(auto& field, auto& m) {
    const wire::Diagnosis& d = *m.diagnosis;
    field("round", d.round);
    field("verdict", d.verdict);
    field("summary", d.summary);
    field("against", m.against);
    field("effects", m.effects);
    field("candidates", rows_of<CandidateRow>(d.candidates));
    field("gain", d.gain);
    field("next_experiments", rows_of<ExperimentRow>(d.next_experiments));
  }
};

/// Nothing where the round has none. Refers to the record.
std::optional<DiagnosisRow> diagnosis_row(const run::RunRecord& run, int round);

}  // namespace nacre::dashboard
