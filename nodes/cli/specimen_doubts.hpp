#pragma once
// Doubts about specimens, for a person to look at before they count in a game.

#include <span>
#include <string>
#include <vector>

#include "laboratory_view.hpp"
#include "run_access.hpp"

namespace nacre::cli {

/// Sentences: specimens that leave the orders of their designs open, and values that the run's model cannot explain but
/// by a mistaken unit.
std::vector<std::string> doubts_about(const RunAccess& run, const LaboratoryView& view,
                                      std::span<const measurement::SpecimenRecord> specimens);

/// Warns of the first few specimens that no model is so far from but by a mistaken unit. Returns a sentence on how many
/// there are, with a blank before it; empty where there are none.
std::string warn_of_units(std::span<const measurement::SpecimenRecord> specimens, const material::ParameterSet& model,
                          tester::Fidelity fidelity);

}  // namespace nacre::cli
