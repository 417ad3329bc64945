#pragma once
// Doubts about specimens, for a person to look at before they count in a game.

#include <span>
#include <vector>

#include "dashboard/desk.hpp"
#include "laboratory_view.hpp"
#include "run_access.hpp"

namespace nacre::cli {

/// Specimens that leave the orders of their designs open, and values that the run's model or its replicates cannot
/// explain but by a mistaken unit.
std::vector<dashboard::SpecimenDoubt> doubts_about(const RunAccess& run, const LaboratoryView& view,
                                                   std::span<const measurement::SpecimenRecord> specimens);

}  // namespace nacre::cli
