#pragma once
// Sentences on tests that could be added to a set.

#include <string>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/possible_tests.hpp"
#include "diagnosis/test_choice.hpp"

namespace nacre::diagnosis {

/// "a twin printed turned by 90 degrees"
std::string in_words(const PossibleTest& test);
/// ", at 40 C, held for 600 s, on the machine "B"": of what is noted; empty where nothing is.
std::string surroundings_in_words(const NextExperiment& experiment);
/// Why a test is proposed: it separates two explanations, given in words; or it tells a material's own E.
struct Separated {
  const PossibleTest& test;
  Separation by;
  std::string one, other;
};
std::string in_words(const Separated& separated);
struct UntoldMaterial {
  ModulusAtBound modulus;
};
std::string in_words(const UntoldMaterial& untold);

/// What a plan adds together: "checkerboards of period 1, 2 and 5"; and one specimen of it.
std::string bundle_in_words(const PossibleTest& test);
std::string specimen_in_words(const PossibleTest& test);

}  // namespace nacre::diagnosis
