#include "measurement/piece.hpp"

namespace nacre::measurement {

std::string piece_of(const SpecimenRecord& specimen) {
  const auto named = specimen.other_columns.find(std::string(kSampleColumn));
  return named == specimen.other_columns.end() ? specimen.specimen : named->second;
}

}  // namespace nacre::measurement
