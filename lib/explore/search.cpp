#include "explore/search.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/ranges.h>

#include "base/result.hpp"
#include "explore/evolution.hpp"
#include "explore/learned.hpp"
#include "explore/model_search.hpp"
#include "explore/random_search.hpp"
#include "explore/rivals/dgemo.hpp"
#include "explore/rivals/egbo.hpp"
#include "explore/rivals/morbo.hpp"
#include "explore/rivals/nehvi.hpp"
#include "explore/rivals/tsemo.hpp"

namespace nacre::explore {
namespace {

using BatchFunction = std::vector<pattern::Pattern> (*)(const BatchRequest&);

/// What chooses the batches of a model-based search; nothing for another.
BatchFunction batch_function(const std::string& algorithm) {
  static const std::map<std::string, BatchFunction> kFunctions = {{"learned", learned_batch}, {"tsemo", tsemo_batch},
                                                                  {"dgemo", dgemo_batch},     {"nehvi", nehvi_batch},
                                                                  {"morbo", morbo_batch},     {"egbo", egbo_batch}};
  const auto found = kFunctions.find(algorithm);
  return found == kFunctions.end() ? nullptr : found->second;
}

void check(bool within, std::string_view key, int value, std::string_view expected) {
  if (!within) throw InputError::format("search: {} = {}, expected {}", key, value, expected);
}

void check_finite(const std::vector<Evaluated>& samples, std::string_view kind) {
  for (const Evaluated& sample : samples) {
    if (!std::isfinite(sample.performance.modulus_pa) || !std::isfinite(sample.performance.toughness_pa)) {
      throw InputError::format("search: {} pattern {} has no finite performance", kind, sample.pattern.key());
    }
  }
}

void check_settings(const SearchSettings& settings) {
  check(settings.budget >= 1, "budget", settings.budget, "at least 1 simulation");
  check(settings.population >= 2, "population", settings.population, "at least 2 patterns");
  check(settings.batch >= 1, "batch", settings.batch, "at least 1 pattern");
  check_finite(settings.known, "known");
  check_finite(settings.former, "former");
  if (settings.algorithm == "learned") check_learned(settings.learned);
}

}  // namespace

std::vector<optimize::Performance> performances_of(std::span<const Evaluated> samples) {
  std::vector<optimize::Performance> performances;
  performances.reserve(samples.size());
  for (const Evaluated& sample : samples) performances.push_back(sample.performance);
  return performances;
}

std::vector<pattern::Pattern> Search::ask_with(std::span<const pattern::Pattern> batch) {
  std::vector<pattern::Pattern> own_batch = ask();
  // One may be longer: the other was the last of a smaller budget.
  const auto [own, given] = std::ranges::mismatch(own_batch, batch);
  if (own != own_batch.end() && given != batch.end())
    throw InputError("search: a batch to go on with is that of another search; name another file of batches");
  return own_batch;
}

const std::vector<std::string>& algorithms() {
  static const std::vector<std::string> kNames = {
      "nsga2", "nsga2-single-pixel", "nsga2-rollback", "random", "learned", "tsemo", "dgemo", "nehvi", "morbo", "egbo"};
  return kNames;
}

std::vector<pattern::Pattern> batch_for(const BatchRequest& batch_request) {
  const BatchFunction batch = batch_function(batch_request.settings.algorithm);
  if (batch == nullptr)
    throw InputError::format("search: algorithm \"{}\" has no batch requests", batch_request.settings.algorithm);
  return batch(batch_request);
}

std::unique_ptr<Search> make_search(const SearchSettings& settings) {
  check_settings(settings);
  const std::string& algorithm = settings.algorithm;
  if (algorithm == "random") return make_random_search(settings);
  if (algorithm == "nsga2") return make_evolution(settings, Variation::three_way);
  if (algorithm == "nsga2-single-pixel") return make_evolution(settings, Variation::single_pixel);
  if (algorithm == "nsga2-rollback") return make_evolution(settings, Variation::single_pixel_rolled_back);
  if (batch_function(algorithm) != nullptr) return make_model_search(settings);
  throw InputError::format("search: algorithm \"{}\", expected one of {}", algorithm, fmt::join(algorithms(), ", "));
}

}  // namespace nacre::explore
