#pragma once
// The patterns that a search has simulated so far: what a gamut will hold, before the proposal agent publishes it.

#include <cstdint>
#include <mutex>
#include <optional>
#include <set>

#include "run/run_record.hpp"
#include "wire/convert.hpp"

namespace nacre::dashboard {

/// Gathers the farm's results of the search of one round, the newest. Any number of threads.
class LiveSearch {
 public:
  /// A SIMULATED, in any order and any number of times. Results of other requests than a search's, those of earlier
  /// rounds and designs that gave no number are left out.
  void take(const wire::SimulateResult& result);

  struct Progress {
    int round = 0;
    int patterns = 0;
    bool operator==(const Progress&) const = default;
  };
  /// Nothing before the first result.
  std::optional<Progress> progress() const;
  /// The patterns of that round's search; empty for any other round.
  run::Gamut gamut(int round) const;

 private:
  mutable std::mutex mutex_;
  int round_ = -1;
  std::set<std::uint64_t> known_;
  run::Gamut gamut_;
};

}  // namespace nacre::dashboard
