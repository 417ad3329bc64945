#pragma once
// A Gaussian process over patterns with the covariance of patch_covariance.hpp.

#include <cstdint>
#include <memory>
#include <span>

#include "surrogate/patch_covariance.hpp"
#include "surrogate/predictor.hpp"

namespace nacre::surrogate {

/// Samples of one quantity: values[i] at patterns[i].
struct Samples {
  std::span<const pattern::Pattern> patterns;
  std::span<const double> values;
  Features trend = {};     ///< the mean of the prior is linear in them, besides a parabola in the rigid fraction
  Features likeness = {};  ///< patterns that are close in them are correlated: a Gaussian covariance added to that of
                           ///< patches
  /// Known variance of the noise of each value. What neighbourhoods cannot explain (PatchKernel::noise_variance) is
  /// then a pattern's own, and part of what is predicted. Empty: not known, and all of that counts as noise.
  std::span<const double> noise_variances = {};
};

/// At most so many samples decide on a kernel.
inline constexpr int kKernelSamples = 300;

/// Kernel of largest marginal likelihood times a weak prior, found from at most kKernelSamples of the samples, chosen
/// by `seed`. `base` as below. Some tenths of a second.
PatchKernel fit_patch_kernel(const Samples& samples, std::uint64_t seed, const Predictor* base = nullptr);

/// Logarithm of the density that a kernel gives the samples that decided on it (as chosen by `seed`), with the prior's
/// mean fitted to all of them: by it the value of a base is judged.
double log_likelihood(const Samples& samples, const PatchKernel& kernel, std::uint64_t seed,
                      const Predictor* base = nullptr);

/// The posterior. O(n^3 / 3) to make, O(n) per mean, O(n^2) per deviation. `base`, when given, is a predictor of a
/// related quantity (another model's, another fidelity's): the prior's mean then has a term b base(x), and the process
/// learns only its errors. Needs one sample.
std::unique_ptr<Predictor> make_patch_process(const Samples& samples, const PatchKernel& kernel,
                                              std::shared_ptr<const Predictor> base = nullptr);

}  // namespace nacre::surrogate
