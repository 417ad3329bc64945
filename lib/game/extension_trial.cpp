#include "game/extension_trial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/statistics.hpp"

namespace nacre::game {
namespace {

const double kDecisiveBayesFactor = std::log10(20.0);
/// Smallest Bayes factor without any one design: one to five. Designs that both models predict within the scatter, one
/// from either side, reach that.
constexpr double kStraddling = -0.7;
constexpr int kFewestDesigns = 3;
constexpr double kFreedom = 4.0;

void add_error(std::vector<OutOfSampleError>& errors, int round, const std::string& design, double measured,
               const std::optional<double>& adopted, const std::optional<double>& extended) {
  if (!(measured > 0.0) || !adopted || !extended || !(*adopted > 0.0) || !(*extended > 0.0)) return;
  errors.push_back({.design = design,
                    .round = round,
                    .adopted = std::log(*adopted / measured),
                    .extended = std::log(*extended / measured)});
}

/// Errors in units of their scatter, by the round of the prediction.
using ByRound = std::map<int, std::vector<double>>;

/// Density of an error about its round's offset, both in units of the scatter: Student's t, with rare outliers of any
/// size. Without these, the less wrong of two models that are both far off one design would win by that alone.
double density(double x, double scatter) {
  constexpr double kOutliers = 0.05, kRange = 6.0;  // one design in twenty; over logarithms, a factor of 400
  const double peak = 0.375;                        // of Student's t with 4 degrees of freedom
  return (1.0 - kOutliers) * peak * std::pow(1.0 + x * x / kFreedom, -0.5 * (kFreedom + 1.0)) +
         kOutliers * scatter / kRange;
}

/// Log likelihood of the errors of one round, up to a constant: their common offset is integrated out over a standard
/// normal distribution by the trapezoid rule.
double log_likelihood(std::span<const double> errors, double scatter) {
  constexpr double kReach = 4.0, kStep = 0.125;
  std::vector<double> logs;
  for (double offset = -kReach; offset <= kReach; offset += kStep) {
    double sum = -0.5 * offset * offset;
    for (const double error : errors) sum += std::log(density(error - offset, scatter));
    logs.push_back(sum);
  }
  const double largest = std::ranges::max(logs);
  double total = 0.0;
  for (const double each : logs) total += std::exp(each - largest);
  return largest + std::log(total);
}

/// 1.48 times the median absolute error: of normal errors the standard deviation.
double scatter_of(std::span<const OutOfSampleError> errors, double OutOfSampleError::*model, double least) {
  std::vector<double> sizes;
  for (const OutOfSampleError& each : errors) sizes.push_back(std::abs(each.*model));
  return std::max(least, 1.4826 * quantile(std::move(sizes), 0.5));
}

/// Decadic logarithm of a model's Bayes factor against the mean prediction.
double evidence(std::span<const OutOfSampleError> errors, double OutOfSampleError::*model, double least) {
  const double scatter = scatter_of(errors, model, least);
  ByRound of_model, of_mean;
  for (const OutOfSampleError& each : errors) {
    of_model[each.round].push_back(each.*model / scatter);
    of_mean[each.round].push_back(0.5 * (each.adopted + each.extended) / scatter);
  }
  double logarithm = 0.0;
  for (const auto& [round, own] : of_model)
    logarithm += log_likelihood(own, scatter) - log_likelihood(of_mean.at(round), scatter);
  return logarithm / std::numbers::ln10;
}

/// The least Bayes factor of the extension (log10) when any one design is left out.
double least_without_one(std::span<const OutOfSampleError> errors, double least) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < errors.size(); ++i) {
    std::vector<OutOfSampleError> others(errors.begin(), errors.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    smallest = std::min(smallest, evidence(others, &OutOfSampleError::extended, least));
  }
  return smallest;
}

bool is_gain(std::span<const OutOfSampleError> errors, double least) {
  const ExtensionTrialStanding standing = standing_of(errors, least);
  return standing.designs >= kFewestDesigns && standing.for_extended >= kDecisiveBayesFactor &&
         least_without_one(errors, least) >= kStraddling;
}

bool is_loss(std::span<const OutOfSampleError> errors, double least) {
  return standing_of(errors, least).for_adopted >= kDecisiveBayesFactor;
}

}  // namespace

void ExtensionTrialErrors::add(int round, const std::vector<measurement::Replicates>& measured,
                               const std::map<std::string, sysid::Prediction>& adopted,
                               const std::map<std::string, sysid::Prediction>& extended) {
  for (const measurement::Replicates& each : measured) {
    const std::string name = each.design.name();
    const auto by_adopted = adopted.find(name), by_extended = extended.find(name);
    if (by_adopted == adopted.end() || by_extended == extended.end()) continue;
    add_error(modulus, round, name, each.modulus_pa, by_adopted->second.modulus_pa, by_extended->second.modulus_pa);
    add_error(toughness, round, name, each.toughness_pa, by_adopted->second.toughness_pa,
              by_extended->second.toughness_pa);
  }
}

ExtensionTrialStanding standing_of(std::span<const OutOfSampleError> errors, double least) {
  ExtensionTrialStanding standing;
  standing.designs = errors.size();
  if (errors.empty()) return standing;
  for (const OutOfSampleError& each : errors) {
    standing.adopted += std::abs(each.adopted) / standing.designs;
    standing.extended += std::abs(each.extended) / standing.designs;
  }
  standing.for_extended = evidence(errors, &OutOfSampleError::extended, least);
  standing.for_adopted = evidence(errors, &OutOfSampleError::adopted, least);
  return standing;
}

bool gain_is_established(const ExtensionTrialErrors& errors) {
  return (is_gain(errors.modulus, kLeastModulusError) && !is_loss(errors.toughness, kLeastToughnessError)) ||
         (is_gain(errors.toughness, kLeastToughnessError) && !is_loss(errors.modulus, kLeastModulusError));
}

}  // namespace nacre::game
