#pragma once
// The analyser's long work: keeping messages, diagnosing, writing the report.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "diagnosis/modulus_floor.hpp"
#include "runtime/node_core.hpp"
#include "wire/convert.hpp"

namespace nacre::analyser {

/// Spec of "store": one message of the run, to be kept in run.db.
std::string store_spec(const std::string& channel, const std::string& payload);

/// What a diagnosis needs to know. The specimens that the request names count as valid: the validation agent asks after
/// it has heard the reviews, and a review that arrives here early or late must not change the answer.
struct DiagnosisTask {
  wire::DiagnoseRequest request;
  std::vector<std::string> measurements;  ///< payloads of the MEASUREMENTs meant, in the order of the request
  int bootstraps = 2000;
  std::uint64_t seed = 1;
  material::ParameterRanges ranges = material::thesis_ranges();
  diagnosis::ModulusFloor floor;
};
/// Spec of "diagnose"; its result is the payload of the DIAGNOSIS.
std::string diagnosis_spec(const DiagnosisTask& task);
std::string diagnose_work(const std::string& spec);

/// All work functions: "store" keeps a message in RUN_DIR/run.db, "report" writes RUN_DIR/report.html from it,
/// "diagnose" is pure.
std::map<std::string, runtime::WorkFunction> work_functions(const std::filesystem::path& run_dir);

}  // namespace nacre::analyser
