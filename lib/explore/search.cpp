#include "explore/search.hpp"

#include <algorithm>
#include <cmath>

#include "base/result.hpp"
#include "explore/evolution.hpp"
#include "explore/random_search.hpp"

namespace nacre::explore {
namespace {

void check(bool within, std::string_view key, int value, std::string_view expected) {
  if (!within) throw InputError::format("search: {} = {}, expected {}", key, value, expected);
}

void check_settings(const SearchSettings& settings) {
  check(settings.budget >= 1, "budget", settings.budget, "at least 1 simulation");
  check(settings.population >= 2, "population", settings.population, "at least 2 patterns");
  check(settings.batch >= 1, "batch", settings.batch, "at least 1 pattern");
  for (const Evaluated& sample : settings.known) {
    if (!std::isfinite(sample.performance.modulus_pa) || !std::isfinite(sample.performance.toughness_pa)) {
      throw InputError::format("search: known pattern {} has no finite performance", sample.pattern.key());
    }
  }
}

}  // namespace

std::unique_ptr<Search> make_search(const SearchSettings& settings) {
  check_settings(settings);
  if (settings.algorithm == "random") return make_random_search(settings);
  if (settings.algorithm == "nsga2") return make_evolution(settings, Variation::three_way);
  if (settings.algorithm == "nsga2-single-pixel") return make_evolution(settings, Variation::single_pixel);
  if (settings.algorithm == "nsga2-rollback") return make_evolution(settings, Variation::single_pixel_rolled_back);
  throw InputError::format("search: algorithm \"{}\", expected nsga2, nsga2-single-pixel, nsga2-rollback or random",
                           settings.algorithm);
}

}  // namespace nacre::explore
