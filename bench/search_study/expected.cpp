#include <cmath>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "base/expected.hpp"
#include "base/parallel.hpp"
#include "base/statistics.hpp"
#include "commands.hpp"
#include "explore/ledger.hpp"
#include "explore/predictors.hpp"
#include "kept_evaluations.hpp"
#include "pattern/pattern_key.hpp"
#include "tester/specimen_numbers.hpp"

namespace nacre::search_study {
namespace {

using explore::Evaluated;

/// What a run knew after its first `tests` fracture tests, from its batches.
std::vector<Evaluated> known_after(const Options& options, std::uint64_t seed, int tests, KeptEvaluations& evaluate) {
  explore::SearchSettings settings = options.search;
  settings.budget = tests;
  explore::Ledger ledger(settings);
  std::ifstream file(run_path(options, options.variant, seed) + "-batches.txt");
  std::map<pattern::Pattern, int> specimens;
  std::string line;
  std::getline(file, line);
  while (ledger.asked() < tests && std::getline(file, line)) {
    std::istringstream keys(line);
    std::vector<std::optional<optimize::Performance>> performances;
    for (std::string key; keys >> key && ledger.room() > 0;) {
      const pattern::Pattern pattern = expected(pattern::pattern_from_key(key));
      if (ledger.seen(pattern))
        ledger.add_again(pattern);
      else
        ledger.add(pattern);
      performances.push_back(evaluate(pattern, specimens[pattern]++).performance);
    }
    ledger.hand_out();
    ledger.record(performances);
  }
  return ledger.evaluated();
}

/// The samples as the search takes them to be: posterior means where it knows the noise, else as tested.
std::vector<Evaluated> reported(const Options& options, std::uint64_t seed, std::span<const Evaluated> known) {
  explore::SearchSettings settings = options.search;
  settings.seed = seed;
  if (settings.algorithm != "learned" || !explore::is_noise_known(known, settings.learned))
    return {known.begin(), known.end()};
  settings.mechanics = mechanics_of(options);
  return explore::estimated(explore::fit_predictors(known, settings), known, settings.learned);
}

std::vector<Evaluated> front_of(const std::vector<Evaluated>& samples) {
  const std::vector<int> ranks = optimize::non_dominated_ranks(explore::performances_of(samples));
  std::vector<Evaluated> front;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (ranks[i] == 1) front.push_back(samples[i]);
  return front;
}

/// The mean over specimens that did not choose the designs.
std::vector<Evaluated> tested_again(const Options& options, const std::vector<Evaluated>& front,
                                    KeptEvaluations& evaluate) {
  std::vector<Evaluated> again = front;
  parallel_for(
      static_cast<int>(front.size()),
      [&](int i) {
        std::vector<double> toughness_pa;
        Evaluated& sample = again[static_cast<std::size_t>(i)];
        for (int specimen = 0; specimen < options.again; ++specimen)
          if (const auto test = evaluate(sample.pattern, tester::kFirstPredictionSpecimen + specimen).performance)
            toughness_pa.push_back(test->toughness_pa);
        sample.performance.toughness_pa = toughness_pa.empty() ? 0.0 : mean(toughness_pa);
        sample.sampling = {static_cast<int>(toughness_pa.size()),
                           standard_deviation(toughness_pa) / std::sqrt(std::max(1.0, 1.0 * toughness_pa.size()))};
      },
      options.threads);
  return again;
}

double hypervolume_of(const std::vector<Evaluated>& samples) {
  return optimize::hypervolume_staircase_gpa_mpa(explore::performances_of(samples));
}

void print_checkpoint(const Options& options, std::uint64_t seed, int tests, KeptEvaluations& evaluate) {
  const std::vector<Evaluated> known = known_after(options, seed, tests, evaluate);
  const std::vector<Evaluated> front = front_of(reported(options, seed, known));
  const std::vector<Evaluated> again = tested_again(options, front, evaluate);
  std::vector<double> log_ratios, scatter;
  for (std::size_t i = 0; i < front.size(); ++i) {
    if (again[i].performance.toughness_pa <= 0.0) continue;
    log_ratios.push_back(std::log(front[i].performance.toughness_pa / again[i].performance.toughness_pa));
    scatter.push_back(again[i].sampling.toughness_se_pa * std::sqrt(again[i].sampling.specimens) /
                      again[i].performance.toughness_pa);
  }
  fmt::print("{},{},{},{},{},{:.4f},{:.4f},{:.3f},{:.3f},{:.3f}\n", options.variant, seed, tests, known.size(),
             front.size(), hypervolume_of(front), hypervolume_of(again), std::exp(mean(log_ratios)),
             standard_deviation(log_ratios), mean(scatter));
}

}  // namespace

void expect_fronts(const Options& options) {
  KeptEvaluations evaluate(options);
  fmt::print(
      "variant,seed,tests,patterns,front,reported_gpa_mpa,expected_gpa_mpa,reported_over_tested_t,ratio_sd,"
      "scatter_of_t\n");
  for (int s = 0; s < options.seeds; ++s)
    for (const int tests : options.checkpoints)
      print_checkpoint(options, options.first_seed + static_cast<std::uint64_t>(s), tests, evaluate);
}

}  // namespace nacre::search_study
