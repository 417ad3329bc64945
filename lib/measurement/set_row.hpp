#pragma once
// One row of measurements.csv.

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/csv.hpp"
#include "measurement/set_columns.hpp"
#include "measurement/specimen_record.hpp"

namespace nacre::measurement {

inline constexpr std::size_t kAbsent = -1;

/// The heading: positions of the known columns, and the other ones.
struct SetHeading {
  std::array<std::size_t, kColumnCount> position;
  std::vector<std::pair<std::size_t, std::string>> others;
  std::size_t cell_count = 0;
};

/// The source of the curve that a row names.
using CurveSource = std::function<Result<tester::Curve>(const std::string& name)>;

/// The record of a row, or its first fault. Files are read from `folder`, curves too unless `curves` has them.
/// `planned`: a row needs no measured value.
tl::expected<SpecimenRecord, RejectedRow> parse_row(const std::filesystem::path& folder, const SetHeading& heading,
                                                    const CsvRow& row, bool planned = false,
                                                    const CurveSource& curves = {});

/// A specimen as cells by column, its curve the file of that name. A column of the author that has the name of one of
/// nacre's is left out.
std::map<std::string, std::string> cells_of(const SpecimenRecord& record, const std::string& curve);

}  // namespace nacre::measurement
