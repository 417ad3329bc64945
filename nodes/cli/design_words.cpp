#include "design_words.hpp"

#include <fmt/format.h>

#include "base/counted.hpp"

namespace nacre::cli {

bool waits_for_approval(const RunAccess& run, const LaboratoryView& view) {
  return run.scenario.validation.approval && !view.is_over;
}

std::string_view stage_in_words(game::DesignStage stage, bool waits_for_approval) {
  if (stage != game::DesignStage::pending) return game::to_string(stage);
  return waits_for_approval ? "waits for approval" : "proposed";
}

std::string price_line(const RunAccess& run, const LaboratoryView& view) {
  const auto price = price_of_round(run, view);
  return !price || run.scenario.laboratory.virtual_lab ? "" : in_words(*price) + "\n";
}

std::string waiting_in_words(int designs) {
  return fmt::format("waits for you: {} to approve (nacre approve DESIGN, or --all; to refuse: --reject --why REASON)",
                     counted(designs, "design"));
}

}  // namespace nacre::cli
