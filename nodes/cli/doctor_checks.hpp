#pragma once
// The checks of `nacre doctor`: each says what it found, and what to type to mend it.

#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/timex.h>

namespace nacre::cli {

/// A remark costs time or comfort; a fault keeps a game from running.
enum class CheckStatus { good, remark, fault };

/// What one check found.
struct Finding {
  std::string check;
  CheckStatus verdict = CheckStatus::good;
  std::string found;
  std::string remedy = {};  ///< what to type; empty when all is well
};

// The programs.
Finding check_programs();
Finding check_versions();

// The network. `lan`: the run spans machines.
Finding check_route(int port, bool lan);
/// A message that this process sends to itself: route, firewall and port together.
Finding check_loopback(int port, bool lan);
Finding check_receive_buffer();

// The machine.
/// Room in the folder, and whether it can be written.
Finding check_disk(const std::filesystem::path& logs);
/// How long the folder's disk takes to keep something for certain, which every measurement waits for.
Finding check_sync(const std::filesystem::path& logs);
/// `now` as the clock says, `status` as ntp_adjtime() says.
Finding judge_clock(std::time_t now, int status);
Finding check_clock();

// The databases.
/// A simulations.db as it is, read only; good where there is none.
Finding check_cache(const std::filesystem::path& file);
/// run.db of a run's folder; good where there is none.
Finding check_run(const std::filesystem::path& run);

// The cluster. `wanted`: the scenario asks for it.
Finding check_slurm(bool wanted);

}  // namespace nacre::cli
