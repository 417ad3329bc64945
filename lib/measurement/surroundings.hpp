#pragma once
// What a specimen was tested in and on, beside rate, thickness and orientation: temperature, humidity, age, machine;
// and whether its strain was held.

#include <optional>
#include <string>

#include "measurement/specimen_record.hpp"

namespace nacre::measurement {

/// Nothing: not noted.
struct Surroundings {
  std::optional<double> temperature_c, humidity_pct, age_days;
  std::string machine;
  bool held = false;  ///< a relaxation modulus, after the time that relaxation_rate() turned into a rate
  bool operator==(const Surroundings&) const = default;
};

/// From the columns `temperature_c`, `humidity_pct`, `age_days`, `machine`, `hold_s`; a cell that is no number tells
/// nothing.
Surroundings surroundings_of(const SpecimenRecord& specimen);

/// The surroundings to within what no laboratory holds: 5 degrees, 10 % of humidity, half of an age. Equal for
/// replicates.
std::string nominal_surroundings(const Surroundings& surroundings);

}  // namespace nacre::measurement
