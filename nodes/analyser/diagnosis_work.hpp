#pragma once
// Specimens and calibrated parameters in, the payload of a DIAGNOSIS out.

#include <cstdint>
#include <string>
#include <vector>

#include "diagnosis/modulus_floor.hpp"
#include "material/parameters.hpp"
#include "material/ranges.hpp"
#include "wire/convert.hpp"

namespace nacre::analyser {

/// What a diagnosis needs to know. The specimens that the request names count as valid: the validation agent sends it
/// after it has received the reviews, and a review that arrives here early or late must not change the diagnosis.
struct DiagnosisTask {
  wire::DiagnoseRequest request;
  std::vector<std::string> measurements;  ///< payloads of the MEASUREMENTs meant, in the order of the request
  int bootstraps = 2000;
  std::uint64_t seed = 1;
  material::ParameterRanges ranges = material::default_ranges();
  diagnosis::ModulusFloor floor;
};
/// Spec of "diagnose"; its result is the payload of the DIAGNOSIS.
std::string diagnosis_spec(const DiagnosisTask& task);
std::string diagnose_work(const std::string& spec);

}  // namespace nacre::analyser
