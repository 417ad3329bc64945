#pragma once
// Which patterns a run has measured, for reports and views.

#include <optional>
#include <vector>

#include "pattern/layout.hpp"
#include "run/run_record.hpp"

namespace nacre::run {

/// A pattern with both E and T measured (standard conditions, valid specimens).
struct MeasuredPattern {
  pattern::Pattern pattern;
  optimize::Performance mean;
  double modulus_sd_pa = 0.0, toughness_sd_pa = 0.0;  ///< sample standard deviation of replicates; 0 for a single one
  int modulus_count = 0, toughness_count = 0;
  int round = 0;  ///< in which it was measured first
};

/// Patterns measured up to and including `round`, by pattern.
std::vector<MeasuredPattern> measured_patterns(const RunRecord& run, int round);

/// Number of the newest round that anything is known of; nothing for an empty record.
std::optional<int> newest_round(const RunRecord& run);
/// Number of the newest closed round.
std::optional<int> newest_closed_round(const RunRecord& run);
/// Whether the last round is closed, and with it the family stage where there is one.
bool is_over(const RunRecord& run);

}  // namespace nacre::run
