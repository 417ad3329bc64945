#pragma once
// Another material, or a missing effect: layouts alone cannot tell.

#include <vector>

#include "diagnosis/evidence.hpp"

namespace nacre::diagnosis {

/// Base materials whose E only layouts or blends tell and which those want beyond their ranges, with E as they want it.
/// None where the base misfits with such constants too.
std::vector<ModulusAtBound> untold_materials(const Evidence& evidence);

}  // namespace nacre::diagnosis
