#include "offline/diagnose.hpp"

#include "diagnosis/diagnose.hpp"
#include "diagnosis/json.hpp"
#include "diagnosis/test_drift.hpp"
#include "diagnosis/words.hpp"
#include "offline/json_parts.hpp"
#include "offline/specimen_units.hpp"

namespace nacre::offline {

DiagnosedSet diagnose_set(const measurement::MeasurementSet& set, const diagnosis::DiagnosisSettings& settings) {
  DiagnosedSet diagnosed{diagnosis::diagnose_or_say_why_not(set.specimens, settings), {}};
  diagnosis::Diagnosis& diagnosis = diagnosed.diagnosis;
  diagnosis.data = diagnosis::summary_of_data(set.specimens, settings.procedure.noise);
  if (diagnosis.verdict == diagnosis::Verdict::insufficient) diagnosis.summary += trends_in_words(diagnosis.data);
  diagnosis.summary += in_words(diagnosis::test_drifts(set.specimens));
  ExpectedMaterials expected{settings.start, settings.start};
  if (diagnosis.base_fit.modulus) expected.of_layouts.modulus = *diagnosis.base_fit.modulus;
  if (diagnosis.base_fit.coupon) expected.of_homogeneous.modulus = *diagnosis.base_fit.coupon;
  SpecimenUnitDoubts doubts = specimen_unit_doubts(set.specimens, expected, settings.fidelity);
  diagnosis.summary += doubts.caution;
  diagnosed.unit_doubts = std::move(doubts.first);
  return diagnosed;
}

measurement::MeasurementSet without_fractures(measurement::MeasurementSet set) {
  std::erase_if(set.specimens, [](const measurement::SpecimenRecord& specimen) {
    return specimen.test == tester::TestKind::toughness;
  });
  return set;
}

nlohmann::ordered_json diagnosis_json(const diagnosis::Diagnosis& diagnosis,
                                      const std::vector<measurement::RejectedRow>& rejected) {
  auto document = nlohmann::ordered_json::parse(diagnosis::to_json(diagnosis));
  document["rejected"] = rejected_json(rejected);
  return document;
}

}  // namespace nacre::offline
