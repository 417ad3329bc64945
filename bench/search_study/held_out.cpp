#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/statistics.hpp"
#include "commands.hpp"
#include "explore/gamut_csv.hpp"
#include "predicted.hpp"

namespace nacre::search_study {
namespace {

/// Spearman's correlation and the mean relative error of predictions.
struct Accuracy {
  double rank = 0.0, error = 0.0;
};

Accuracy accuracy(std::span<const explore::Evaluated> samples, std::span<const optimize::Performance> predicted,
                  double optimize::Performance::*property) {
  std::vector<double> truth, guess;
  double error = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    truth.push_back(samples[i].performance.*property);
    guess.push_back(predicted[i].*property);
    error += std::abs(guess.back() / std::max(1.0, truth.back()) - 1.0) / static_cast<double>(samples.size());
  }
  return {rank_correlation(truth, guess), error};
}

}  // namespace

void predict_held_out(const Options& options) {
  fmt::print("variant,seed,learnt_from,next,E_rank,E_error,T_rank,T_error,T_rank_learnt,fit_s\n");
  for (int s = 0; s < options.seeds; ++s) {
    const std::uint64_t seed = options.first_seed + static_cast<std::uint64_t>(s);
    const auto gamut = explore::read_gamut_csv(run_path(options, options.variant, seed) + "-gamut.csv");
    for (const int count : options.checkpoints) {
      const auto learnt = static_cast<std::size_t>(count);
      if (learnt >= gamut.size()) break;
      const Predicted predicted = predict(options, seed, gamut, learnt);
      const auto first = predicted.samples.first(learnt), later = predicted.samples.subspan(learnt);
      const std::span<const optimize::Performance> guesses(predicted.predicted);
      const Accuracy e = accuracy(later, guesses.subspan(learnt), &optimize::Performance::modulus_pa);
      const Accuracy t = accuracy(later, guesses.subspan(learnt), &optimize::Performance::toughness_pa);
      const Accuracy own = accuracy(first, guesses.first(learnt), &optimize::Performance::toughness_pa);
      fmt::print("{},{},{},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.2f}\n", options.variant, seed, learnt, later.size(),
                 e.rank, e.error, t.rank, t.error, own.rank, predicted.fitting_s);
    }
  }
}

}  // namespace nacre::search_study
