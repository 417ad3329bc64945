#pragma once

#include <vector>

#include "diagnosis/scatter.hpp"

namespace nacre::diagnosis {

/// What replicates of one group say of the time at which they were printed and tested.
struct HistoryRow {
  Row row;
  double value = 0.0;  ///< change of the feature per batch step, or per specimen printed within a batch
};

/// Slopes of log E, log T and log peak stress over batches and over print order, by least squares on deviations from
/// the groups' means: independent of those means, so that they add to what designs say. Only where replicates of one
/// group differ in them.
std::vector<HistoryRow> history_rows(const std::vector<std::vector<Measured>>& groups);

}  // namespace nacre::diagnosis
