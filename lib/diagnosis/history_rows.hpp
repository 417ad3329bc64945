#pragma once
// Least-squares slopes of features over batches and print order, within groups of replicates.

#include <map>
#include <string>
#include <vector>

#include "diagnosis/scatter.hpp"

namespace nacre::diagnosis {

/// Dependence of a feature on when specimens were printed and tested, between replicates of one group.
struct HistoryRow {
  DataRow row;
  double value = 0.0;         ///< change of the feature per batch step, or per specimen printed within a batch
  double piece_weight = 0.0;  ///< weight of the row if nothing scattered but pieces, which return in other groups
  std::map<std::string, double> of_batches;  ///< value if one batch is off by 1 and nothing else; not of print order
};

/// Slopes of log E, log T and log peak stress over batches and over print order, by least squares on deviations from
/// the groups' means: independent of those means, so that they add information to those of designs. Then how far single
/// batches lie off the slope, each freed of the slope and of the batches before it. Only where replicates of one group
/// differ in them, and `fewest` specimens at least show it.
std::vector<HistoryRow> history_rows(const std::vector<std::vector<Measured>>& groups, int fewest);

}  // namespace nacre::diagnosis
