#include "latencies.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "base/statistics.hpp"

namespace nacre::load {

void Latencies::print(const std::string& what) const {
  if (seconds_.empty()) return;
  const double all = std::accumulate(seconds_.begin(), seconds_.end(), 0.0);
  fmt::print("{:<48} {:>7} times  median {:>9.3f} ms  99 % {:>9.3f} ms  largest {:>9.3f} ms  together {:>8.2f} s\n",
             what, seconds_.size(), 1e3 * quantile(seconds_, 0.5), 1e3 * quantile(seconds_, 0.99),
             1e3 * *std::max_element(seconds_.begin(), seconds_.end()), all);
  std::fflush(stdout);
}

std::string peak_memory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return fmt::format("{:.0f} MB", static_cast<double>(usage.ru_maxrss) / 1024.0);
}

}  // namespace nacre::load
