#pragma once
// Effects of the specimens' history (batch, operator, machine, date, print order) on their values: differences of
// ln E and ln T from the mean of the same design, by Student's t with Bonferroni's correction.

#include <string>
#include <vector>

#include "measurement/specimen_record.hpp"

namespace nacre::measurement {

/// By how much specimens of one batch, operator, machine or date differ from others of the same designs.
struct HistoryEffect {
  std::string factor;  ///< `batch`, `operator`, `machine`, `date`; `print_order` for the trend
  std::string level;   ///< which one; "per 10 specimens" for the trend
  tester::TestKind test = tester::TestKind::modulus;
  double relative = 0.0;        ///< exp(mean difference of log) - 1
  double standard_error = 0.0;  ///< of it
  int specimens = 0;
  double chance = 1.0;  ///< of any of the effects being as large where there are none: Student's t, by Bonferroni
  bool notable() const { return chance < 0.05; }
};

/// Effects of the specimens' history on modulus and toughness, each against the mean of its own design, so that it does
/// not matter which designs were in a batch. Means of designs and levels cost the scatter degrees of freedom. Levels
/// that share no design with others are left out.
std::vector<HistoryEffect> history_effects(const std::vector<SpecimenRecord>& specimens);

}  // namespace nacre::measurement
