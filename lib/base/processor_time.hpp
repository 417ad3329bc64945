#pragma once

#include <ctime>

namespace nacre {

/// Processor time of the calling thread, s: the cost of its work, independent of the machine's load.
inline double processor_time_s() {
  std::timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace nacre
