#include "runtime/version.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "base/shipped_files.hpp"
#include "runtime/run_folder.hpp"
#include "tester/simulation_key.hpp"

namespace nacre::runtime {

std::string version_in_words() {
  constexpr std::size_t kShownDigits = 12;
  const std::string commit = build_commit();
  const std::size_t end_of_hash = commit.find('+');
  const std::string changes = end_of_hash == std::string::npos ? "" : commit.substr(end_of_hash);
  return fmt::format("nacre {}, commit {}{}, kernel {}, messages {}", NACRE_VERSION,
                     commit.substr(0, std::min(kShownDigits, end_of_hash)), changes, tester::kKernelVersion,
                     kSchemaVersion);
}

}  // namespace nacre::runtime
