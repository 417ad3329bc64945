#pragma once
// The diagnosis of a measurement set in this process.

#include <vector>

#include <nlohmann/json.hpp>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/settings.hpp"
#include "measurement/read_set.hpp"

namespace nacre::offline {

struct DiagnosedSet {
  diagnosis::Diagnosis diagnosis;
  std::vector<std::string> unit_doubts;  ///< a sentence on each of the first few
};

/// Diagnoses the specimens of a set; the summary tells which units are in doubt, and where too little was measured what
/// the data show by themselves.
DiagnosedSet diagnose_set(const measurement::MeasurementSet& set, const diagnosis::DiagnosisSettings& settings);

/// The set without its fracture tests, which take most of the time of a diagnosis: each is simulated some eighty times.
measurement::MeasurementSet without_fractures(measurement::MeasurementSet set);

/// The JSON document of `nacre diagnose --json`.
nlohmann::ordered_json diagnosis_json(const diagnosis::Diagnosis& diagnosis,
                                      const std::vector<measurement::RejectedRow>& rejected);

}  // namespace nacre::offline
