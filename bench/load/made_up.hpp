#pragma once
// Contents for the load: numbers that look like results and mean nothing.

#include <vector>

#include "base/random.hpp"
#include "explore/search.hpp"
#include "measurement/specimen_record.hpp"

namespace nacre::load {

/// A curve that rises and falls.
tester::Curve made_up_curve(int points, RandomStream& random);
/// Random patterns, each once.
std::vector<explore::Evaluated> made_up_gamut(int count, RandomStream& random);
/// Fracture and modulus specimens of `designs` random patterns in turn.
std::vector<measurement::SpecimenRecord> made_up_specimens(int count, int designs, RandomStream& random);

}  // namespace nacre::load
