#pragma once
// Tables without patterns: rank correlation of log(measured / predicted) with each column, by permutation of the rows.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "measurement/specimen_record.hpp"

namespace nacre::diagnosis {

/// Rank correlation of log(measured / predicted) with one numeric column.
struct Trend {
  std::string column;
  double spearman = 0.0;
  double p_family_wise = 1.0;  ///< chance of a correlation as strong along any column when rows are exchangeable
  int rows = 0;                ///< rows with a number in all three columns
};

struct TableTrends {
  std::vector<Trend> trends;  ///< strongest first
  std::vector<measurement::RejectedRow> rejected;
};

/// Trends of a CSV table; the predicted values themselves are one of the columns. Left out, with the reason, are rows
/// that are no CSV, that have another number of cells than the heading, without two positive numbers, or with a number
/// that is not finite. Throws InputError when a column is missing or stands twice, or fewer than five rows are usable.
TableTrends table_trends(const std::filesystem::path& table, const std::string& measured, const std::string& predicted,
                         std::uint64_t seed, int permutations = 2000);

}  // namespace nacre::diagnosis
