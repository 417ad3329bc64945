#include "explore/rivals/family_front.hpp"

#include <algorithm>
#include <limits>
#include <set>

namespace nacre::explore {
namespace {

constexpr double kForbidden = std::numeric_limits<double>::infinity();

/// The cheapest chain over the families that are allowed (Viterbi).
FamilyAssignment cheapest_chain(const std::vector<std::vector<double>>& prices, const std::vector<bool>& allowed,
                                const FamilyPrices& settings) {
  const std::size_t families = allowed.size();
  std::vector<double> best(families, 0.0);
  std::vector<std::vector<int>> from(prices.size(), std::vector<int>(families));
  for (std::size_t cell = 0; cell < prices.size(); ++cell) {
    const auto cheapest = static_cast<int>(std::min_element(best.begin(), best.end()) - best.begin());
    const double changed = best[cheapest] + (cell > 0 ? settings.change : 0.0);
    for (std::size_t family = 0; family < families; ++family) {
      const bool stays = best[family] <= changed;
      from[cell][family] = stays ? static_cast<int>(family) : cheapest;
      best[family] = allowed[family] ? std::min(best[family], changed) + prices[cell][family] : kForbidden;
    }
  }
  FamilyAssignment result;
  result.family.resize(prices.size());
  auto family = static_cast<int>(std::min_element(best.begin(), best.end()) - best.begin());
  result.price = prices.empty() ? 0.0 : best[family];
  for (std::size_t cell = prices.size(); cell-- > 0;) {
    result.family[cell] = family;
    family = from[cell][family];
  }
  const std::set<int> used(result.family.begin(), result.family.end());
  result.price += settings.family * static_cast<double>(used.size());
  return result;
}

}  // namespace

FamilyAssignment assign_families(const std::vector<std::vector<double>>& prices, const FamilyPrices& settings) {
  std::vector<bool> allowed(prices.empty() ? 0 : prices.front().size(), true);
  FamilyAssignment best = cheapest_chain(prices, allowed, settings);
  for (bool improved = true; improved;) {
    improved = false;
    const std::set<int> used(best.family.begin(), best.family.end());
    if (used.size() <= 1) break;
    int given_up = -1;
    for (const int family : used) {
      allowed[family] = false;
      FamilyAssignment without = cheapest_chain(prices, allowed, settings);
      allowed[family] = true;
      if (without.price < best.price) best = std::move(without), given_up = family;
    }
    if (given_up >= 0) allowed[given_up] = false, improved = true;
  }
  return best;
}

}  // namespace nacre::explore
