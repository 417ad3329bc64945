#pragma once
// What may explain the data, each beside what it leaves free: the next tests are to separate these.

#include <string>
#include <vector>

#include "diagnosis/factors.hpp"
#include "diagnosis/verdict.hpp"

namespace nacre::diagnosis {

struct Explanation {
  FittedModel model;
  FreeLevels beside = {};
};

/// Each of these models beside the free levels that the evidence was judged beside.
std::vector<Explanation> beside_levels_of(const Evidence& evidence, std::vector<FittedModel> models);

/// What the next tests should separate: laws of a condition that explain the data equally well; a named law of a
/// condition, its free levels, and those of a condition that goes with it; conditions that these data cannot part; a
/// machine and the specimens that were tested on it; forms of a named effect. Where no condition is in question the
/// models that stay possible, the effects that come nearest to an unexplained misfit, or, where nothing would show,
/// each effect, and the base. Fewer than two: nothing is in question.
std::vector<Explanation> explanations_to_separate(const Evidence& evidence, const Decision& decision);

/// "power-law rate dependence with temperature shift", "a dependence on temperature", "power-law rate dependence beside
/// a dependence on machine".
std::string in_words(const Explanation& explanation);

}  // namespace nacre::diagnosis
