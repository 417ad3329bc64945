#pragma once
// What the virtual laboratory has simulated of one truth, kept beside the runs: a response depends on nothing else, so
// that a game which is played again does not wait for its laboratory.

#include <filesystem>

#include "laboratory/truth.hpp"
#include "runtime/node_core.hpp"

namespace nacre::virtual_lab {

/// In the folder of runs: a file for each response.
inline constexpr const char* kKeptFolder = "virtual_lab.kept";

/// `work` of this truth, of a pure function of its spec, done once and then read from `folder`. A file that is damaged
/// or that cannot be written costs the time of the work, nothing else. Thread-safe, as are several processes at once.
runtime::WorkFunction kept(runtime::WorkFunction work, const laboratory::Truth& truth,
                           const std::filesystem::path& folder);

}  // namespace nacre::virtual_lab
