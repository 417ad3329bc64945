#pragma once
// The family stage's long work: which families there are, and the variants around their seeds.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "families/grouping.hpp"
#include "runtime/node_core.hpp"

namespace nacre::validation_agent {

/// Spec of a Compute of kind "group_families": everything measured, Pa, and up to which rank designs are near-Pareto.
std::string grouping_spec(const std::vector<families::MeasuredPattern>& measured, int rank);

struct Grouping {
  std::vector<families::SeedFamily> families;
  std::string remark;  ///< whose families they are, for a person
  bool file_is_faulty = false;
};
/// The result of a grouping.
Grouping grouping_from(const std::string& result);

/// Spec of a Compute of kind "sample_family": `samples` patterns around the seeds, seeds included.
std::string sampling_spec(const families::SeedFamily& family, int samples, std::uint64_t seed);
/// The result of a sampling: seeds first.
std::vector<pattern::Pattern> sample_from(const std::string& result);

/// Work functions of the validation agent. RUN/families/families.toml holds the families: where a person left one, it
/// is taken (and a faulty one passed over with a warning), else the proposal is written there. An empty folder: no
/// file.
std::map<std::string, runtime::WorkFunction> work_functions(const std::filesystem::path& run_dir);

}  // namespace nacre::validation_agent
