#include "explore/predictors.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "base/statistics.hpp"
#include "explore/surrogate_search.hpp"
#include "surrogate/network.hpp"
#include "surrogate/patch_process.hpp"
#include "thesis/constants.hpp"

namespace nacre::explore {
namespace {

using surrogate::Predictor;

/// Samples decide on kernels, and networks are trained in full on them, anew only when they have become this many times
/// more: a fit to fewer is a good start until then, and equal searches do it at equal places. (Toughness lies under a
/// floor that every sample moves a little: its kernel is searched in every batch, some 0.1 s.)
constexpr double kKernelGrowth = 1.3;
constexpr std::size_t kFirstKernelSamples = 20;
/// Patterns with the logarithms of their properties. A property that is not positive counts as `kLeast` of a unit.
struct LogSamples {
  std::vector<pattern::Pattern> patterns;
  std::vector<double> log_modulus, log_toughness;
};

/// A parabola over the rigid fraction, by least squares to the first `deciding` values.
std::vector<double> trend_of(const std::vector<pattern::Pattern>& patterns, const std::vector<double>& values,
                             std::size_t deciding) {
  Eigen::MatrixXd terms(static_cast<Eigen::Index>(patterns.size()), 3);
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    const double fraction = patterns[i].rigid_fraction();
    terms.row(static_cast<Eigen::Index>(i)) << 1.0, fraction, fraction * fraction;
  }
  const auto rows = static_cast<Eigen::Index>(deciding);
  const Eigen::Map<const Eigen::VectorXd> y(values.data(), rows);
  const Eigen::VectorXd trend = terms * terms.topRows(rows).colPivHouseholderQr().solve(y);
  return {trend.begin(), trend.end()};
}

/// Raises what lies too far below the trend of the first `deciding`. The values of bad patterns carry no
/// information on good ones, and the few that fail at once (a factor of a hundred) would make the process too rough and
/// too uncertain everywhere.
void raise_to_floor(const std::vector<pattern::Pattern>& patterns, std::vector<double>& values, std::size_t deciding,
                    double deviations) {
  constexpr std::size_t kFewest = 10;
  constexpr int kTimes = 4;  // the trend itself is drawn down at first
  if (deviations <= 0.0 || deciding < kFewest) return;
  const std::vector<double> as_they_are = values;
  for (int time = 0; time < kTimes; ++time) {
    const std::vector<double> trend = trend_of(patterns, values, deciding);
    std::vector<double> residuals(deciding);
    for (std::size_t i = 0; i < deciding; ++i) residuals[i] = values[i] - trend[i];
    // Of the upper half, which has no tail: its quartile lies 0.674 deviations above the middle.
    const double middle = quantile(residuals, 0.5), deviation = (quantile(residuals, 0.75) - middle) / 0.674;
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = std::max(as_they_are[i], trend[i] + middle - deviations * deviation);
  }
}

/// Toughness with the floor of the settings, which the first `deciding` samples lay.
LogSamples logarithms(std::span<const Evaluated> samples, std::size_t deciding, const LearnedSettings& learned) {
  constexpr double kLeast = 1.0;  // Pa: softer or weaker than anything that holds together
  LogSamples logs;
  for (const Evaluated& sample : samples) {
    logs.patterns.push_back(sample.pattern);
    logs.log_modulus.push_back(std::log(std::max(kLeast, sample.performance.modulus_pa)));
    logs.log_toughness.push_back(std::log(std::max(kLeast, sample.performance.toughness_pa)));
  }
  raise_to_floor(logs.patterns, logs.log_toughness, deciding, learned.floor_deviations);
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

/// Builds on `base` only while that makes the samples more probable than no base does: predictions of another model for
/// good patterns may be wrong, and are then worse than none.
std::shared_ptr<const Predictor> fit_patches(const surrogate::Samples& deciding, const surrogate::Samples& learnt,
                                             std::uint64_t seed, std::shared_ptr<const Predictor> base) {
  auto kernel = surrogate::fit_patch_kernel(deciding, seed, base.get());
  if (base) {
    const auto alone = surrogate::fit_patch_kernel(deciding, seed);
    if (surrogate::log_likelihood(deciding, alone, seed) >=
        surrogate::log_likelihood(deciding, kernel, seed, base.get())) {
      base.reset();
      kernel = alone;
    }
  }
  return surrogate::make_patch_process(learnt, kernel, std::move(base));
}

/// A base predictor plus a predictor of its errors.
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
  std::vector<surrogate::PatternPrediction> predict(std::span<const pattern::Pattern> at) const override {
    const std::vector<double> base = base_->means(at);
    std::vector<surrogate::PatternPrediction> sum = remainder_->predict(at);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i].mean += base[i];
    return sum;
  }
  Eigen::MatrixXd covariance(std::span<const pattern::Pattern> at) const override { return remainder_->covariance(at); }

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
  modulus.network.residual_blocks = thesis::kModulusResidualBlocks;
  modulus.network.dropout = 0.0;
  modulus.network.weight_decay = thesis::kModulusWeightDecay;
  modulus.network.epochs = thesis::kModulusEpochs;
  return {fit_networks(all.patterns, all.log_modulus, settled, modulus, base.modulus),
          fit_networks(all.patterns, all.log_toughness, settled, toughness, base.toughness)};
}

}  // namespace

std::vector<Evaluated> learnt_samples(std::span<const Evaluated> samples, int most) {
  std::vector<Evaluated> learnt = best_by_rank(samples, samples.size());
  const std::size_t all = learnt.size(), count = most, best = count / 2;
  if (all <= count) return learnt;
  for (std::size_t i = best; i < count; ++i) learnt[i] = learnt[best + (i - best) * (all - best) / (count - best)];
  learnt.erase(learnt.begin() + most, learnt.end());
  return learnt;
}

Predictors fit_predictors(std::span<const Evaluated> samples, const SearchSettings& settings, const Predictors& base) {
  const LearnedSettings& learned = settings.learned;
  const std::size_t stage = settled_samples(samples.size());
  // The samples that networks were trained on in full must not change, or they would be trained anew at every batch
  // (minutes).
  if (learned.predictor == "networks") return fit_networks(logarithms(samples, stage, learned), stage, settings, base);
  const LogSamples all = logarithms(samples, samples.size(), learned);
  const std::vector<Evaluated> chosen = learnt_samples(samples, learned.most_samples);
  const LogSamples learnt = logarithms(chosen, chosen.size(), learned);
  const auto fit = [&](const std::vector<double> LogSamples::*property, const surrogate::Features& trend,
                       const surrogate::Features& likeness, const std::shared_ptr<const Predictor>& of_base) {
    return fit_patches({std::span(all.patterns).first(stage), std::span(all.*property).first(stage), trend, likeness},
                       {learnt.patterns, learnt.*property, trend, likeness}, settings.seed, of_base);
  };
  return {fit(&LogSamples::log_modulus, settings.mechanics.cell_modulus, {}, base.modulus),
          fit(&LogSamples::log_toughness, {}, settings.mechanics.cell_loads, base.toughness)};
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
