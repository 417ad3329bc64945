#include "explore/predictors.hpp"

#include <algorithm>
#include <cmath>

#include "explore/surrogate_search.hpp"
#include "surrogate/network.hpp"
#include "surrogate/patch_process.hpp"

namespace nacre::explore {
namespace {

using surrogate::Predictor;

/// Kernels are decided, and networks trained in full, anew only when the samples have become this many times more: what
/// fewer samples say is a good start until then, and equal searches do it at equal places.
constexpr double kKernelGrowth = 1.3;
constexpr std::size_t kFirstKernelSamples = 20;
/// Patterns with the logarithms of their properties. A property that is not positive counts as `kLeast` of a unit.
struct LogSamples {
  std::vector<pattern::Pattern> patterns;
  std::vector<double> log_modulus, log_toughness;
};

LogSamples logarithms(std::span<const Evaluated> samples) {
  constexpr double kLeast = 1.0;  // Pa: softer or weaker than anything that holds together
  LogSamples logs;
  for (const Evaluated& sample : samples) {
    logs.patterns.push_back(sample.pattern);
    logs.log_modulus.push_back(std::log(std::max(kLeast, sample.performance.modulus_pa)));
    logs.log_toughness.push_back(std::log(std::max(kLeast, sample.performance.toughness_pa)));
  }
  return logs;
}

/// How many of the first `size` samples decide on the kernel, or are those that networks are trained on in full.
std::size_t settled_samples(std::size_t size) {
  const auto grown = [](std::size_t stage) {
    return static_cast<std::size_t>(std::ceil(kKernelGrowth * static_cast<double>(stage)));
  };
  std::size_t stage = std::min(size, kFirstKernelSamples);
  while (grown(stage) <= size) stage = grown(stage);
  return stage;
}

std::shared_ptr<const Predictor> fit_patches(const surrogate::Samples& deciding, const surrogate::Samples& learnt,
                                             std::uint64_t seed, std::shared_ptr<const Predictor> base) {
  const auto kernel = surrogate::fit_patch_kernel(deciding, seed, base.get());
  return surrogate::make_patch_process(learnt, kernel, std::move(base));
}

/// What a predictor of the remainder adds to a base.
class Sum final : public Predictor {
 public:
  Sum(std::shared_ptr<const Predictor> base, std::unique_ptr<Predictor> remainder)
      : base_(std::move(base)), remainder_(std::move(remainder)) {}
  std::vector<double> means(std::span<const pattern::Pattern> at) const override {
    std::vector<double> sum = base_->means(at);
    const std::vector<double> remainder = remainder_->means(at);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += remainder[i];
    return sum;
  }
  std::vector<surrogate::Prediction> predict(std::span<const pattern::Pattern> at) const override {
    const std::vector<double> base = base_->means(at);
    std::vector<surrogate::Prediction> sum = remainder_->predict(at);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i].mean += base[i];
    return sum;
  }

 private:
  std::shared_ptr<const Predictor> base_;
  std::unique_ptr<Predictor> remainder_;
};

std::shared_ptr<const Predictor> fit_networks(const std::vector<pattern::Pattern>& patterns, std::vector<double> values,
                                              std::size_t settled, const surrogate::EnsembleSettings& settings,
                                              std::shared_ptr<const Predictor> base) {
  if (!base) return surrogate::fit_ensemble({patterns, values}, settled, settings);
  const std::vector<double> known = base->means(patterns);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= known[i];
  return std::make_shared<Sum>(std::move(base), surrogate::fit_ensemble({patterns, values}, settled, settings));
}

/// Networks of 2.3.3 for both properties; all samples in the order of evaluation.
Predictors fit_networks(const LogSamples& all, std::size_t settled, const SearchSettings& settings,
                        const Predictors& base) {
  const LearnedSettings& learned = settings.learned;
  surrogate::EnsembleSettings toughness{.network = {.dropout = learned.dropout, .weight_decay = learned.weight_decay},
                                        .members = learned.members,
                                        .warm_start = learned.warm_start};
  toughness.network.seed = settings.seed;
  surrogate::EnsembleSettings modulus = toughness;
  modulus.network.residual_blocks = 2;
  modulus.network.dropout = 0.0;
  modulus.network.weight_decay = 1e-6;
  modulus.network.epochs = 100;
  return {fit_networks(all.patterns, all.log_modulus, settled, modulus, base.modulus),
          fit_networks(all.patterns, all.log_toughness, settled, toughness, base.toughness)};
}

}  // namespace

Predictors fit_predictors(std::span<const Evaluated> samples, const SearchSettings& settings, const Predictors& base) {
  const LogSamples all = logarithms(samples);
  const std::size_t stage = settled_samples(samples.size());
  if (settings.learned.predictor == "networks") return fit_networks(all, stage, settings, base);
  const LogSamples learnt = logarithms(best_by_rank(samples, static_cast<std::size_t>(settings.learned.most_samples)));
  const auto fit = [&](const std::vector<double> LogSamples::*property, surrogate::PriorMean prior_mean,
                       const std::shared_ptr<const Predictor>& of_base) {
    return fit_patches({std::span(all.patterns).first(stage), std::span(all.*property).first(stage), prior_mean},
                       {learnt.patterns, learnt.*property, prior_mean}, settings.seed, of_base);
  };
  return {fit(&LogSamples::log_modulus, surrogate::PriorMean::fraction_and_conductance, base.modulus),
          fit(&LogSamples::log_toughness, surrogate::PriorMean::fraction, base.toughness)};
}

std::vector<optimize::Performance> believed(const Predictors& predictors, std::span<const pattern::Pattern> at,
                                            double optimism) {
  std::vector<optimize::Performance> performances(at.size());
  if (optimism == 0.0) {
    const auto modulus = predictors.modulus->means(at), toughness = predictors.toughness->means(at);
    for (std::size_t i = 0; i < at.size(); ++i) performances[i] = {std::exp(modulus[i]), std::exp(toughness[i])};
    return performances;
  }
  const auto modulus = predictors.modulus->predict(at), toughness = predictors.toughness->predict(at);
  for (std::size_t i = 0; i < at.size(); ++i) {
    performances[i] = {std::exp(modulus[i].mean + optimism * modulus[i].deviation),
                       std::exp(toughness[i].mean + optimism * toughness[i].deviation)};
  }
  return performances;
}

}  // namespace nacre::explore
