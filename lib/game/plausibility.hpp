#pragma once
// Whether a specimen can be what it is said to be, by the model of the day: units are mistaken by factors of ten and
// more, models by less.

#include <optional>
#include <string>

#include "material/parameters.hpp"
#include "measurement/measurement.hpp"
#include "tester/tester.hpp"

namespace nacre::game {

/// A doubt about the unit of a valid specimen, as a sentence; nothing where there is none. A modulus is held against
/// that which the model simulates for the design (milliseconds), a notched specimen's curve by the slope of its
/// beginning.
std::optional<std::string> doubt_of_unit(const measurement::SpecimenRecord& specimen,
                                         const material::ParameterSet& model, tester::Fidelity fidelity);

}  // namespace nacre::game
