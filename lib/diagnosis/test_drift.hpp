#pragma once
// Drift of a testing machine over the order of its tests, where the column `test_order` tells it.

#include <string>
#include <vector>

#include "measurement/specimen_record.hpp"

namespace nacre::diagnosis {

/// Change of stiffness from the first to the last test on one machine, between specimens of one design, batch and set
/// of conditions: what these change is no drift.
struct TestDrift {
  std::string machine;  ///< empty: not noted
  int tests = 0;
  double ratio = 1.0;            ///< last over first
  double low = 1.0, high = 1.0;  ///< 90 % interval
  double chance = 1.0;           ///< of as large a change by scatter alone, times the number of machines
};

/// Least squares of log E over the order, of every machine whose tests leave a degree of freedom at least.
std::vector<TestDrift> test_drifts(const std::vector<measurement::SpecimenRecord>& specimens);

/// A caution with a space in front on those that chance explains in fewer than one case of a hundred; empty: none.
std::string in_words(const std::vector<TestDrift>& drifts);

}  // namespace nacre::diagnosis
