#include "runtime/version.hpp"

#include <fmt/core.h>

#include "runtime/run_folder.hpp"
#include "tester/simulation_key.hpp"

namespace nacre::runtime {

std::string version_in_words() {
  return fmt::format("nacre {}, kernel {}, messages {}", NACRE_VERSION, tester::kKernelVersion, kSchemaVersion);
}

}  // namespace nacre::runtime
