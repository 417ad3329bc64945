#pragma once
// Which rows of a set are tests of one and the same piece of material.

#include <string>
#include <string_view>

#include "measurement/specimen_record.hpp"

namespace nacre::measurement {

/// The column that names the piece, where one piece was tested several times.
inline constexpr std::string_view kSampleColumn = "sample";

/// The piece: of the column `sample`, the specimen itself where that is empty.
std::string piece_of(const SpecimenRecord& specimen);

}  // namespace nacre::measurement
