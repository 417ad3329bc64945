#pragma once
// Specimens, calibrated parameters and fracture tests that the farm has simulated in, the payload of a DIAGNOSIS out.

#include <cstdint>
#include <string>
#include <vector>

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
  int simulations = 0;  ///< fracture tests that the farm may simulate for it
  material::ParameterRanges ranges = material::default_ranges();
  std::string floor_toml;              ///< discretisation floor (data/discretisation_floor.toml); empty: none
  std::vector<std::string> simulated;  ///< payloads of the farm's SIMULATEDs, for a diagnosis
};
/// Spec of "plan" and "diagnose".
std::string diagnosis_spec(const DiagnosisTask& task);

/// The payloads of the SIMULATEs that the diagnosis wants responses to next, packed (runtime::pack): some of them
/// follow what others have taught. None where it has all, where there are no fracture tests, or too few simulations for
/// them.
std::string plan_work(const std::string& spec);

/// The payload of the DIAGNOSIS. Without any responses to what plan_work() wants it looks at no fracture tests.
std::string diagnose_work(const std::string& spec);

}  // namespace nacre::analyser
