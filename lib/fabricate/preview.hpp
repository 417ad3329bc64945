#pragma once

#include <filesystem>

#include "fabricate/droplet_plan.hpp"

namespace nacre::fabricate {

/// Writes a picture of the middle layer in true proportions: on the left the whole specimen, each point in the mean
/// colour of its droplets (pattern/phase_colours.hpp), on the right a close-up of 3 x 3 mm at the notch's tip or at the
/// middle of a bar, in which every droplet shows, scale bars of 10 and 1 mm, and a legend. Throws InputError naming the
/// file.
void write_preview(const DropletPlan& plan, const std::filesystem::path& path);

}  // namespace nacre::fabricate
