#include <chrono>
#include <map>

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "base/processor_time.hpp"
#include "commands.hpp"
#include "explore/batch_log.hpp"
#include "explore/gamut_csv.hpp"
#include "explore/surrogate_search.hpp"
#include "kept_evaluations.hpp"

namespace nacre::search_study {
namespace {

using Clock = std::chrono::steady_clock;

/// Growth of one run, a row whenever a batch is told: fracture tests, hypervolumes, processor seconds of the batch.
study::StudyTable growth_table(const Options& options, std::uint64_t seed) {
  return {run_path(options, options.variant, seed) + "-growth.csv",
          {"staircase_gpa_mpa", "polygon_gpa_mpa", "thinking_s", "simulating_s"}};
}

/// One search; what the files hold is passed through without being thought about or simulated again.
bool run_one(const Options& options, std::uint64_t seed, KeptEvaluations& evaluate, Clock::time_point end) {
  explore::SearchSettings settings = options.search;
  settings.seed = seed;
  settings.mechanics = mechanics_of(options);
  const auto search = explore::make_search(settings);
  explore::BatchLog log(run_path(options, options.variant, seed) + "-batches.txt", settings);
  study::StudyTable growth = growth_table(options, seed);
  std::map<pattern::Pattern, int> specimens;  // tested so far
  auto tests = static_cast<int>(settings.known.size());
  while (true) {
    if (Clock::now() >= end) return false;
    const bool is_new = log.left() == 0;
    const double begin = processor_time_s();
    const std::vector<pattern::Pattern> batch = log.ask(*search);
    const double thinking = is_new ? processor_time_s() - begin : 0.0;
    if (batch.empty()) break;
    std::vector<std::optional<optimize::Performance>> answers(batch.size());
    std::vector<double> spent(batch.size());
    std::vector<int> numbers;
    for (const pattern::Pattern& pattern : batch) numbers.push_back(specimens[pattern]++);
    parallel_for(
        static_cast<int>(batch.size()),
        [&](int i) {
          const auto index = static_cast<std::size_t>(i);
          const auto answer = evaluate(batch[index], numbers[index]);
          answers[index] = answer.performance;
          spent[index] = answer.processor_s;
        },
        options.threads);
    search->tell(answers);
    tests += static_cast<int>(batch.size());
    const std::string samples = fmt::format("{}", tests);
    if (growth.find(samples)) continue;
    double simulating = 0.0;
    for (const double each : spent) simulating += each;
    const auto points = explore::performances_of(search->evaluated());
    growth.add(samples, {optimize::hypervolume_staircase_gpa_mpa(points), optimize::hypervolume_polygon_gpa_mpa(points),
                         thinking, simulating});
  }
  const auto points = explore::performances_of(search->evaluated());
  fmt::print("{} seed {}: {} samples, hypervolume {:.5f} GPa MPa\n", options.variant, seed, points.size(),
             optimize::hypervolume_staircase_gpa_mpa(points));
  explore::write_gamut_csv(run_path(options, options.variant, seed) + "-gamut.csv", search->evaluated());
  return true;
}

}  // namespace

std::string run_path(const Options& options, const std::string& variant, std::uint64_t seed) {
  return fmt::format("{}/{}-{}-{}-{}", options.work, options.fidelity, options.set, variant, seed);
}

bool run_searches(const Options& options) {
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double, std::ratio<60>>(std::min(options.minutes, 1e6)));
  KeptEvaluations evaluate(options);
  for (int i = 0; i < options.seeds; ++i) {
    if (!run_one(options, options.first_seed + static_cast<std::uint64_t>(i), evaluate, end)) return false;
  }
  return true;
}

}  // namespace nacre::search_study
