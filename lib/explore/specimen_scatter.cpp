#include "explore/specimen_scatter.hpp"

#include <algorithm>
#include <cmath>

#include "base/square.hpp"

namespace nacre::explore {
namespace {

/// (se / T)^2, the variance of ln T by the delta method.
double relative_variance(const Evaluated& sample) {
  return square(sample.sampling.toughness_se_pa / std::max(1.0, sample.performance.toughness_pa));
}

}  // namespace

SpecimenScatter::SpecimenScatter(std::span<const Evaluated> samples) {
  for (const Evaluated& sample : samples) {
    const int specimens = sample.sampling.specimens;
    if (specimens > 1)
      repeated_.push_back({sample.pattern.rigid_fraction(), specimens * relative_variance(sample), specimens - 1.0});
  }
}

double SpecimenScatter::variance_at(const pattern::Pattern& pattern) const {
  constexpr double kAlike = 0.05;  // rigid fractions
  double sum = kPriorFreedom * square(kPriorScatter), freedom = kPriorFreedom;
  for (const Repeated& each : repeated_) {
    const double weight =
        each.freedom * std::exp(-0.5 * square((each.rigid_fraction - pattern.rigid_fraction()) / kAlike));
    sum += weight * each.variance;
    freedom += weight;
  }
  return sum / freedom;
}

double SpecimenScatter::noise_of(const Evaluated& sample) const {
  if (sample.sampling.specimens == 1 && sample.sampling.toughness_se_pa > 0.0) return relative_variance(sample);
  return variance_at(sample.pattern) / sample.sampling.specimens;
}

bool has_known_noise(std::span<const Evaluated> samples) {
  return std::ranges::any_of(samples, [](const Evaluated& sample) { return sample.sampling != Sampling{}; });
}

}  // namespace nacre::explore
