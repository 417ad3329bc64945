#pragma once

#include <filesystem>

#include "fabricate/droplet_plan.hpp"

namespace nacre::fabricate {

/// Writes a picture of the middle layer in true proportions: the whole specimen (points between soft, black, and rigid,
/// white, by the share of droplets; what is not printed is blue) and beside it a close-up of 3 x 3 mm, at the notch's
/// tip or at the middle of a bar, in which every droplet shows. Throws InputError naming the file.
void write_preview(const DropletPlan& plan, const std::filesystem::path& path);

}  // namespace nacre::fabricate
