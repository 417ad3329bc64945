#pragma once
// How much specimens of one design differ in toughness, learnt from designs of which several were tested.

#include <span>
#include <vector>

#include "explore/search.hpp"

namespace nacre::explore {

/// Standard deviation of ln T between specimens that is expected before any design was tested twice: of random layouts
/// at the default strength_cv (docs/studies/toughness.md), and how many degrees of freedom that counts for.
inline constexpr double kPriorScatter = 0.09, kPriorFreedom = 4.0;

/// Variances of ln T. The scatter depends on the design: it is the mean over designs tested more than once, weighted
/// by their degrees of freedom and by likeness in rigid fraction, and drawn to the prior.
class SpecimenScatter {
 public:
  explicit SpecimenScatter(std::span<const Evaluated> samples);
  /// Between specimens of a pattern.
  double variance_at(const pattern::Pattern& pattern) const;
  /// Of the mean over a sample's specimens: as told where their number is not known, else scatter / specimens.
  double noise_of(const Evaluated& sample) const;

 private:
  /// A design of which several specimens were tested.
  struct Repeated {
    double rigid_fraction = 0.0, variance = 0.0, freedom = 0.0;
  };
  std::vector<Repeated> repeated_;
};

/// Whether the noise of T is known: a sample is the mean over specimens, or has a standard error.
bool has_known_noise(std::span<const Evaluated> samples);

}  // namespace nacre::explore
