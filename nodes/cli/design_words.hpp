#pragma once
// Designs of a run in words, as `nacre designs` and `nacre approve` print them.

#include <string>
#include <string_view>

#include "laboratory_view.hpp"

namespace nacre::cli {

/// Whether pending designs wait for a person: the game asks for approvals, and goes on.
bool waits_for_approval(const RunAccess& run, const LaboratoryView& view);

/// "approved", "printed", ...; a pending design "waits for approval", or is "proposed" where nobody is asked.
std::string_view stage_in_words(game::DesignStage stage, bool waits_for_approval);

/// What the round at hand costs, as a line of a game with people; empty for the virtual laboratory and once nothing
/// more is measured.
std::string price_line(const RunAccess& run, const LaboratoryView& view);

/// "waits for you: 1 design to approve", and what to type.
std::string waiting_in_words(int designs);

}  // namespace nacre::cli
