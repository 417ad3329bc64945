#pragma once
// What a finished run would have been told by a predictor of its first samples.

#include <span>
#include <vector>

#include "commands.hpp"

namespace nacre::search_study {

/// Samples of a run in their order, those learnt from first, and what is predicted of them.
struct Predicted {
  std::span<const explore::Evaluated> samples;
  std::vector<optimize::Performance> predicted;
  double fitting_s = 0.0;  ///< of a processor
};

/// Learns the options' way from the first `learnt` (fewer than there are) of a run's samples, and predicts them and the
/// options' `next` after them. The result refers to `run`.
Predicted predict(const Options& options, std::uint64_t seed, std::span<const explore::Evaluated> run,
                  std::size_t learnt);

}  // namespace nacre::search_study
