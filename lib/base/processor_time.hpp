#pragma once

#include <ctime>

namespace nacre {

/// Time that the calling thread has spent on a processor, s: what work costs, whoever else uses the machine.
inline double processor_time_s() {
  std::timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace nacre
