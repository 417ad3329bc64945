#include "predicted.hpp"

#include <algorithm>

#include "base/processor_time.hpp"
#include "explore/predictors.hpp"
#include "kept_evaluations.hpp"

namespace nacre::search_study {

Predicted predict(const Options& options, std::uint64_t seed, std::span<const explore::Evaluated> run,
                  std::size_t learnt) {
  Predicted predicted;
  predicted.samples = run.first(std::min(run.size(), learnt + static_cast<std::size_t>(options.next)));
  explore::SearchSettings settings = options.search;
  settings.seed = seed;
  settings.mechanics = mechanics_of(options);
  const double begin = processor_time_s();
  explore::Predictors former;
  if (!settings.former.empty()) former = explore::fit_predictors(settings.former, settings);
  const explore::Predictors predictors = explore::fit_predictors(run.first(learnt), settings, former);
  predicted.fitting_s = processor_time_s() - begin;
  std::vector<pattern::Pattern> patterns;
  for (const explore::Evaluated& sample : predicted.samples) patterns.push_back(sample.pattern);
  predicted.predicted = explore::believed(predictors, patterns, 0.0);
  return predicted;
}

}  // namespace nacre::search_study
