#pragma once

#include <filesystem>
#include <span>

#include "fabricate/job.hpp"

namespace nacre::fabricate {

/// Writes a picture of a tray as the printer sees it from above, its front at the bottom: the middle layer of every
/// specimen in the colours of previews, its label in the middle, a scale bar of 50 mm, a legend. `plans`: of the job's
/// models, in their order. Throws InputError naming the file.
void write_tray_preview(const Job& job, int tray, std::span<const DropletPlan> plans,
                        const std::filesystem::path& path);

}  // namespace nacre::fabricate
