#include "dashboard/live_search.hpp"

#include "base/names.hpp"

namespace nacre::dashboard {

void LiveSearch::take(const wire::SimulateResult& result) {
  const auto round = number_between("proposal_agent/r", "/s", result.request_id);  // of a search alone
  const std::lock_guard lock(mutex_);
  if (!round || *round < round_) return;
  if (*round > round_) {
    round_ = *round;
    known_.clear();
    gamut_ = {};
  }
  for (const wire::SimulatedDesign& each : result.results) {
    const pattern::Layout* layout = each.design.layout();
    const auto pattern = layout != nullptr ? pattern::Pattern::from_layout(*layout) : std::nullopt;
    if (!each.failure.empty() || !pattern || !known_.insert(pattern->bits()).second) continue;
    gamut_.patterns.push_back(pattern->bits());
    gamut_.performances.push_back({each.modulus_pa, each.toughness_pa});
  }
}

std::optional<LiveSearch::Progress> LiveSearch::progress() const {
  const std::lock_guard lock(mutex_);
  if (gamut_.patterns.empty()) return std::nullopt;
  return Progress{round_, static_cast<int>(gamut_.patterns.size())};
}

run::Gamut LiveSearch::gamut(int round) const {
  const std::lock_guard lock(mutex_);
  return round == round_ ? gamut_ : run::Gamut{};
}

}  // namespace nacre::dashboard
