#include "offline/diagnose.hpp"

#include "diagnosis/diagnose.hpp"
#include "diagnosis/included_specimens.hpp"
#include "diagnosis/json.hpp"
#include "diagnosis/words.hpp"
#include "offline/json_parts.hpp"
#include "offline/specimen_units.hpp"

namespace nacre::offline {
namespace {

diagnosis::Diagnosis diagnosis_of(const diagnosis::IncludedSpecimens& part,
                                  const diagnosis::DiagnosisSettings& settings) {
  try {
    return diagnosis::diagnose(part.specimens, settings);
  } catch (const diagnosis::TooFewSpecimens& problem) {
    return diagnosis::undecided(problem.what());
  }
}

}  // namespace

diagnosis::Diagnosis diagnose_set(const measurement::MeasurementSet& set, bool fracture,
                                  const diagnosis::DiagnosisSettings& settings) {
  const diagnosis::IncludedSpecimens part = diagnosis::included_specimens(set.specimens, fracture);
  diagnosis::Diagnosis diagnosis = diagnosis_of(part, settings);
  diagnosis.summary +=
      left_out_in_words(part) + specimen_unit_doubts(set.specimens, settings.start, settings.fidelity).caution;
  return diagnosis;
}

nlohmann::ordered_json diagnosis_json(const diagnosis::Diagnosis& diagnosis,
                                      const std::vector<measurement::RejectedRow>& rejected) {
  auto document = nlohmann::ordered_json::parse(diagnosis::to_json(diagnosis));
  document["rejected"] = rejected_json(rejected);
  return document;
}

}  // namespace nacre::offline
