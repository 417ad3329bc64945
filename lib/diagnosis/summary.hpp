#pragma once
// The sentences of a diagnosis for a person: what was found, what it gains, what to beware of.

#include <string>
#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/other_materials.hpp"
#include "diagnosis/verdict.hpp"

namespace nacre::diagnosis {

/// The gain of a named effect on designs that the fit has not seen, in a sentence: errors as per cent of E and T, and a
/// gain (or a loss) only where the 90 % interval leaves no doubt of its sign. A cause may be sure and its gain not: the
/// base imitates most of it there.
std::string gain_in_words(const Gain& gain);

/// Whether the choice of designs changes, in a sentence for each of E and T; empty where no two designs differ by
/// enough.
std::string choice_in_words(const Gain& gain);

/// Verdict with its reason, gain, and everything that limits what the verdict is worth. `at_bounds`: moduli of the fit
/// at their bounds (CoordinateMap); `others`: materials that are none of the inks; `out_of_line`: groups whose
/// replicates do not agree.
std::string summary_with_cautions(const Diagnosis& diagnosis, const Decision& decision,
                                  const Observations& observations, const std::vector<ModulusAtBound>& at_bounds,
                                  const std::vector<OtherMaterial>& others, const std::vector<std::string>& out_of_line,
                                  const Procedure& procedure);

}  // namespace nacre::diagnosis
