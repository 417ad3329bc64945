#pragma once
// The analyser's long work: keeping messages, diagnosing (diagnosis_work.hpp), writing the report.

#include <filesystem>
#include <map>
#include <string>

#include "runtime/node_core.hpp"

namespace nacre::analyser {

/// Spec of "store": one message of the run, to be kept in run.db.
std::string store_spec(const std::string& channel, const std::string& payload);

/// All work functions: "store" keeps a message in RUN_DIR/run.db, "report" writes RUN_DIR/report.html from it,
/// "plan" and "diagnose" are pure.
std::map<std::string, runtime::WorkFunction> work_functions(const std::filesystem::path& run_dir);

}  // namespace nacre::analyser
