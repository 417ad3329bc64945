#pragma once
// One task of a cluster: simulates a batch, on any machine that sees the run's folder.

#include <filesystem>
#include <string>

namespace nacre::simulator_farm {

/// Simulates the batch of task `task` of `wave` and puts its result into the spool, by one rename at the end; a sign of
/// life is left there every few seconds. A batch that is over or done already is left alone. Returns the exit status: 0
/// done or nothing to do, 1 the batch cannot be read (the reason on standard error). Throws InputError.
int run_batch_task(const std::filesystem::path& spool, const std::string& wave, int task);

}  // namespace nacre::simulator_farm
