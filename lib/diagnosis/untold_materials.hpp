#pragma once
// Another material, or a missing effect: layouts alone cannot tell.

#include <vector>

#include "diagnosis/evidence.hpp"

namespace nacre::diagnosis {

/// Base materials whose E only layouts or blends tell and which those want beyond their ranges, with E as they want it.
/// None where the base explains the data within the inks' ranges too, or misfits with such constants too.
std::vector<ModulusAtBound> untold_materials(const Evidence& evidence);

/// The same of a model that explains the data with constants at the bounds of the search: its effect may be all that is
/// missing, of other inks, or the constants make up for another one. Moduli of layouts alone; none where it explains
/// the data within the inks' ranges too.
std::vector<ModulusAtBound> untold_materials_of(const Evidence& evidence, const FittedModel& model);

}  // namespace nacre::diagnosis
