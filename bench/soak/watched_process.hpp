#pragma once
// What a process holds, read from /proc.

#include <string>
#include <vector>

#include <sys/types.h>

namespace nacre::soak {

struct WatchedProcess {
  pid_t pid = 0;
  std::string name;           ///< of its program file
  double resident_bytes = 0;  ///< memory in RAM
  double descriptors = 0;     ///< open files
  double threads = 0;
};

/// The running children of `parent`. One that ends meanwhile is left out.
std::vector<WatchedProcess> children_of(pid_t parent);

}  // namespace nacre::soak
