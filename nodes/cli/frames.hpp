#pragma once

#include <string>
#include <vector>

#include "tester/tester.hpp"

namespace nacre::cli {

/// Writes FOLDER/STEM-0000.png, ... : one picture per frame, 4 x 4 points per element; black soft, white rigid, grey
/// interface, tinted red by the strain energy density relative to the largest of the film, blue void or failed. Throws
/// InputError.
void write_frames(const std::string& folder, const std::string& stem, const std::vector<tester::FractureFrame>& frames);

}  // namespace nacre::cli
