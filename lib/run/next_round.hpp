#pragma once
// Whether another round is worth it, as the run tells so far.

#include <optional>
#include <string>
#include <vector>

#include "game/round_growth.hpp"
#include "run/run_record.hpp"

namespace nacre::run {

/// The growth of the measured hypervolume in the last two closed rounds, and what the proposals of the newest closed
/// round are expected to add once they are measured. Their scatter is that of all earlier proposals' out-of-sample
/// errors. Those of round 1 are left out: its model had seen no pattern, and the one that is used has. With fewer than
/// three errors it is that of the fit: a mean relative error m of normal errors is a standard deviation of m
/// sqrt(pi/2).
struct NextRound {
  static constexpr int kFewestErrors = 3;
  struct Brought {
    int round = 0;
    game::Growth growth;
  };
  int round = 0;                         ///< the next one
  double hypervolume_gpa_mpa = 0.0;      ///< measured so far
  std::vector<Brought> brought;          ///< by round
  std::optional<game::Growth> expected;  ///< nothing: `unknown` says why
  bool is_scatter_of_fit = false;
  std::string unknown;
};
NextRound next_round(const RunRecord& run);

/// "round 2 brought 0.045 +- 0.006 GPa MPa of measured hypervolume, round 3 0.030 +- 0.014; round 4 is expected to
/// bring 0.012 +- 0.010, 4 % of 0.316 (90 %: 0 to 0.031)". Before a round is measured: that it cannot be told yet.
std::string in_words(const NextRound& next);

}  // namespace nacre::run
