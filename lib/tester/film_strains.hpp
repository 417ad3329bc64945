#pragma once

#include <vector>

#include "tester/toughness.hpp"

namespace nacre::tester {

/// Strains of a film's `count` >= 2 frames, increasing from 0 to the end of the test: a quarter of them equally spaced,
/// the rest denser where elements fail, where the stress changes direction or falls, and around the peak. Needs the
/// result's curve, breaks and failure strain; the same result gives the same strains.
std::vector<double> film_strains(const ToughnessResult& result, int count);

}  // namespace nacre::tester
