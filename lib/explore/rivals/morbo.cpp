#include "explore/rivals/morbo.hpp"

#include <algorithm>
#include <bit>

#include "explore/model_search.hpp"
#include "explore/rivals/cube_beliefs.hpp"
#include "explore/surrogate_search.hpp"
#include "pattern/mutation.hpp"

namespace nacre::explore {
namespace {

constexpr std::size_t kRegions = 3;
constexpr int kFirstRadius = 16, kLargestRadius = 32, kSmallestRadius = 4;
constexpr int kSuccesses = 2, kFailures = 3;

int flips_between(const pattern::Pattern& a, const pattern::Pattern& b) { return std::popcount(a.bits() ^ b.bits()); }

bool is_inside(const pattern::Pattern& pattern, const TrustRegion& region) {
  return flips_between(pattern, region.centre) <= region.radius;
}

struct RegionState {
  TrustRegion region;
  int successes = 0, failures = 0;
};

/// At the best sample that is far from the other centres and from where the region was; at the best where none is.
void restart(RegionState& state, std::span<const RegionState> others, std::span<const Evaluated> samples) {
  const std::vector<Evaluated> ordered = best_by_rank(samples, samples.size());
  const auto is_far = [&](const Evaluated& sample) {
    return std::ranges::all_of(others, [&](const RegionState& other) {
      return flips_between(sample.pattern, other.region.centre) > kFirstRadius;
    });
  };
  const auto found = std::ranges::find_if(ordered, is_far);
  state = {.region = {(found == ordered.end() ? ordered.front() : *found).pattern, kFirstRadius}};
}

void recentre(TrustRegion& region, std::span<const Evaluated> samples) {
  std::vector<Evaluated> inside;
  std::ranges::copy_if(samples, std::back_inserter(inside),
                       [&](const Evaluated& sample) { return is_inside(sample.pattern, region); });
  if (!inside.empty()) region.centre = best_by_rank(inside, 1).front().pattern;
}

/// Whether a sample of a batch inside the region was dominated by nothing before.
bool has_grown(const TrustRegion& region, std::span<const Evaluated> before, std::span<const Evaluated> batch) {
  return std::ranges::any_of(batch, [&](const Evaluated& sample) {
    return is_inside(sample.pattern, region) && std::ranges::none_of(before, [&](const Evaluated& earlier) {
             return optimize::dominates(earlier.performance, sample.performance);
           });
  });
}

void count(RegionState& state, bool has_grown) {
  state.successes = has_grown ? state.successes + 1 : 0;
  state.failures = has_grown ? 0 : state.failures + 1;
  if (state.successes == kSuccesses) state.successes = 0, state.region.radius *= 2;
  if (state.failures == kFailures) state.failures = 0, state.region.radius /= 2;
  state.region.radius = std::min(state.region.radius, kLargestRadius);
}

/// Models of the samples near a region, at least some of them.
std::vector<ObjectiveModel> local_models(const TrustRegion& region, std::span<const Evaluated> samples,
                                         std::uint64_t seed) {
  constexpr std::size_t kFewest = 60;
  std::vector<Evaluated> near(samples.begin(), samples.end());
  const auto flips = [&](const Evaluated& sample) { return flips_between(sample.pattern, region.centre); };
  std::ranges::stable_sort(near, {}, flips);
  const auto inside = std::ranges::count_if(near, [&](const auto& each) { return flips(each) <= 2 * region.radius; });
  near.resize(std::min(near.size(), std::max(kFewest, static_cast<std::size_t>(inside))));
  return fit_cube_models(near, seed);
}

/// Mutants of the centre within the region.
std::vector<Evaluated> mutants(const TrustRegion& region, RandomStream& random) {
  constexpr int kTries = 400, kSmall = 8;
  const auto kind = region.radius <= kSmall ? pattern::MutationKind::single_pixel : pattern::MutationKind::three_way;
  std::vector<Evaluated> patterns;
  for (int i = 0; i < kTries; ++i) {
    pattern::Pattern mutant = region.centre;
    for (int step = random.index(3); step >= 0; --step) mutant = pattern::mutate(mutant, kind, random);
    if (is_inside(mutant, region)) patterns.push_back({mutant, {}});
  }
  return patterns;
}

}  // namespace

std::vector<TrustRegion> trust_regions(std::span<const Evaluated> samples, int batch) {
  std::vector<RegionState> states;
  std::size_t told = std::min(samples.size(), static_cast<std::size_t>(batch));
  for (std::size_t k = 0; k < kRegions; ++k) {
    RegionState state;
    restart(state, states, samples.first(told));
    states.push_back(state);
  }
  while (told < samples.size()) {
    const auto before = samples.first(told);
    const auto newest = samples.subspan(told, std::min(samples.size() - told, static_cast<std::size_t>(batch)));
    told += newest.size();
    for (RegionState& state : states) {
      count(state, has_grown(state.region, before, newest));
      if (state.region.radius < kSmallestRadius)
        restart(state, states, samples.first(told));
      else
        recentre(state.region, samples.first(told));
    }
  }
  std::vector<TrustRegion> regions;
  for (const RegionState& state : states) regions.push_back(state.region);
  return regions;
}

std::vector<pattern::Pattern> morbo_batch(const BatchRequest& batch_request) {
  const std::uint64_t seed = batch_seed(batch_request);
  RandomStream random(seed, "explore/morbo");
  const std::span<const Evaluated> samples(batch_request.evaluated);
  std::vector<pattern::Pattern> patterns;
  std::vector<Belief> beliefs;
  for (const TrustRegion& region : trust_regions(samples, batch_request.settings.batch)) {
    std::vector<pattern::Pattern> local;
    for (const Evaluated& each : unseen(mutants(region, random), batch_request))
      if (std::ranges::find(patterns, each.pattern) == patterns.end()) local.push_back(each.pattern);
    if (local.empty()) continue;
    const std::vector<Belief> believed = cube_beliefs(local_models(region, samples, seed), local);
    patterns.insert(patterns.end(), local.begin(), local.end());
    beliefs.insert(beliefs.end(), believed.begin(), believed.end());
  }
  std::vector<pattern::Pattern> batch;
  for (const std::size_t i : best_improvements(beliefs, performances_of(samples), batch_request.count))
    batch.push_back(patterns[i]);
  return batch;
}

}  // namespace nacre::explore
