#pragma once
// The surrogate model of `learned`: a predictor per property, fitted to the simulated samples.

#include <memory>
#include <span>
#include <vector>

#include "explore/search.hpp"
#include "surrogate/predictor.hpp"

namespace nacre::explore {

/// Predictors of the natural logarithms of modulus and toughness in Pa; empty when nothing was learnt.
struct Predictors {
  std::shared_ptr<const surrogate::Predictor> modulus, toughness;
};

/// Which of `samples` (at least one) are learnt from when they are more than `most`: one half are the best by rank, the
/// other is spread evenly over the rest. The best alone do not show what makes the others worse.
std::vector<Evaluated> learnt_samples(std::span<const Evaluated> samples, int most);

/// Fitted to `samples` (at least one), on top of `base` predictors where there are such. Depends on its arguments only.
Predictors fit_predictors(std::span<const Evaluated> samples, const SearchSettings& settings,
                          const Predictors& base = {});

/// Whether the predictor of toughness takes samples for means over specimens, with known noise, and predicts E[T].
bool is_noise_known(std::span<const Evaluated> samples, const LearnedSettings& learned);

/// Samples with the posterior mean of E[T] in place of their toughness, where the noise is known; the best of them by
/// rank with its standard deviation as standard error, the others at the median. Those so bad that their toughness was
/// raised to the floor stay as told.
std::vector<Evaluated> estimated(const Predictors& predictors, std::span<const Evaluated> samples,
                                 const LearnedSettings& learned);
inline constexpr std::size_t kEstimatedWithError = 200;

/// The objective of a search on the predictors: medians, raised by `optimism` deviations.
std::vector<optimize::Performance> believed(const Predictors& predictors, std::span<const pattern::Pattern> at,
                                            double optimism);

}  // namespace nacre::explore
