#include "explore/predictors.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "base/square.hpp"
#include "base/statistics.hpp"
#include "explore/specimen_scatter.hpp"
#include "explore/surrogate_search.hpp"
#include "optimize/best_by_rank.hpp"
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
  std::vector<double> noise_variances;  ///< of log_toughness; empty: not known
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

/// Toughness with the floor of the settings, which the first `deciding` samples lay. `scatter`, where the noise is
/// known, gives its variance s^2; ln E[T] lies s^2/2 above the expectation of ln T.
LogSamples logarithms(std::span<const Evaluated> samples, std::size_t deciding, const LearnedSettings& learned,
                      const SpecimenScatter* scatter = nullptr) {
  constexpr double kLeast = 1.0;  // Pa: softer or weaker than anything that holds together
  LogSamples logs;
  for (const Evaluated& sample : samples) {
    logs.patterns.push_back(sample.pattern);
    logs.log_modulus.push_back(std::log(std::max(kLeast, sample.performance.modulus_pa)));
    logs.log_toughness.push_back(std::log(std::max(kLeast, sample.performance.toughness_pa)));
  }
  if (scatter != nullptr) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      logs.noise_variances.push_back(scatter->noise_of(samples[i]));
      logs.log_toughness[i] += 0.5 * logs.noise_variances[i];
    }
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
  const SpecimenScatter scatter(samples);
  const SpecimenScatter* const known = is_noise_known(samples, learned) ? &scatter : nullptr;
  const LogSamples all = logarithms(samples, samples.size(), learned, known);
  const std::vector<Evaluated> chosen = learnt_samples(samples, learned.most_samples);
  const LogSamples learnt = logarithms(chosen, chosen.size(), learned, known);
  const std::span<const pattern::Pattern> first(all.patterns.data(), stage);
  const surrogate::Features &cell_modulus = settings.mechanics.cell_modulus,
                            &cell_loads = settings.mechanics.cell_loads;
  const std::size_t noisy = std::min(stage, all.noise_variances.size());
  return {fit_patches({first, std::span(all.log_modulus).first(stage), cell_modulus, {}},
                      {learnt.patterns, learnt.log_modulus, cell_modulus, {}}, settings.seed, base.modulus),
          fit_patches({first,
                       std::span(all.log_toughness).first(stage),
                       {},
                       cell_loads,
                       std::span(all.noise_variances).first(noisy)},
                      {learnt.patterns, learnt.log_toughness, {}, cell_loads, learnt.noise_variances}, settings.seed,
                      base.toughness)};
}

bool is_noise_known(std::span<const Evaluated> samples, const LearnedSettings& learned) {
  return learned.predictor == "patches" && (learned.specimens > 1 || has_known_noise(samples));
}

std::vector<Evaluated> estimated(const Predictors& predictors, std::span<const Evaluated> samples,
                                 const LearnedSettings& learned) {
  std::vector<Evaluated> estimates(samples.begin(), samples.end());
  const SpecimenScatter scatter(samples);
  const LogSamples logs = logarithms(samples, samples.size(), learned, &scatter);
  const std::vector<pattern::Pattern>& patterns = logs.patterns;
  const std::vector<double> log_means = predictors.toughness->means(patterns);
  std::vector<bool> is_raised(samples.size());
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    double& toughness_pa = estimates[i].performance.toughness_pa;
    is_raised[i] = logs.log_toughness[i] > std::log(std::max(1.0, toughness_pa)) + logs.noise_variances[i];
    if (is_raised[i])
      estimates[i].sampling.toughness_se_pa = toughness_pa * std::sqrt(logs.noise_variances[i]);
    else
      toughness_pa = std::exp(log_means[i]);
  }
  std::vector<std::size_t> best = optimize::best_by_rank(performances_of(estimates), kEstimatedWithError);
  std::vector<pattern::Pattern> of_best;
  std::erase_if(best, [&](std::size_t i) { return is_raised[i]; });
  for (const std::size_t i : best) of_best.push_back(patterns[i]);
  const auto predictions = predictors.toughness->predict(of_best);
  for (std::size_t k = 0; k < best.size(); ++k) {
    Evaluated& estimate = estimates[best[k]];
    const double mean_pa = std::exp(predictions[k].mean + 0.5 * square(predictions[k].deviation));
    estimate.performance.toughness_pa = mean_pa;
    estimate.sampling.toughness_se_pa = mean_pa * predictions[k].deviation;
  }
  return estimates;
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
