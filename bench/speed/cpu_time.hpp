#pragma once

#include "base/processor_time.hpp"

namespace nacre::bench {

/// Processor time that `work` takes, s.
template <class Work>
double seconds_of(const Work& work) {
  const double start = processor_time_s();
  work();
  return processor_time_s() - start;
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
