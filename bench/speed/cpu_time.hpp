#pragma once

#include <ctime>

namespace nacre::bench {

/// Time of this thread on a processor, s: other work on the machine does not count.
inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class Work>
double seconds_of(const Work& work) {
  const double start = cpu_seconds();
  work();
  return cpu_seconds() - start;
}

/// Least time of `repeats` runs after one that is not counted.
template <class Work>
double least_seconds_of(int repeats, const Work& work) {
  work();
  double least = seconds_of(work);
  for (int i = 1; i < repeats; ++i) {
    const double seconds = seconds_of(work);
    if (seconds < least) least = seconds;
  }
  return least;
}

}  // namespace nacre::bench
