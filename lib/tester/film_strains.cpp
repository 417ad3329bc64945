#include "tester/film_strains.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace nacre::tester {
namespace {

/// Intervals in which events are counted; their width smooths bursts of failures in a single step.
constexpr int kIntervals = 400;
/// Shares of the frames. The rest is spaced equally, so that nothing is ever skipped.
constexpr double kBreakShare = 0.45, kFallShare = 0.20, kPeakShare = 0.10;
/// Half width of the region around the peak, as a share of the test's strain.
constexpr double kPeakHalfWidth = 0.04;

/// Adds `share`, distributed over the intervals as `events` are; nothing when there are none.
void add_share(std::vector<double>& density, const std::vector<double>& events, double share) {
  double sum = 0.0;
  for (const double event : events) sum += event;
  if (sum <= 0.0) return;
  for (std::size_t i = 0; i < density.size(); ++i) density[i] += share * events[i] / sum;
}

/// A burst in one interval is spread over its neighbours, so that the moments before and after it are seen, too.
std::vector<double> spread(const std::vector<double>& events) {
  std::vector<double> result(events.size(), 0.0);
  constexpr int kReach = 3;
  for (int i = 0; i < kIntervals; ++i)
    for (int j = std::max(0, i - kReach); j <= std::min(kIntervals - 1, i + kReach); ++j)
      result[j] += events[i] * (kReach + 1 - std::abs(i - j));
  return result;
}

}  // namespace

std::vector<double> film_strains(const ToughnessResult& result, int count) {
  assert(count >= 2 && result.failure_strain > 0.0);
  const double width = result.failure_strain / kIntervals;
  const auto interval = [width](double strain) {
    return static_cast<std::size_t>(std::clamp(static_cast<int>(strain / width), 0, kIntervals - 1));
  };
  std::vector<double> breaks(kIntervals, 0.0), falls(kIntervals, 0.0), peak(kIntervals, 0.0);
  // The root: a thousand failures in one interval look no different from ten in each of ten.
  for (const Break& broken : result.breaks) breaks[interval(broken.strain)] += 1.0;
  for (double& events : breaks) events = std::sqrt(events);
  const std::vector<double>& strain = result.curve.strain;
  const std::vector<double>& stress = result.curve.stress_pa;
  for (std::size_t i = 1; i < strain.size(); ++i)
    falls[interval(strain[i])] += std::max(0.0, stress[i - 1] - stress[i]);
  const auto top = std::max_element(stress.begin(), stress.end());
  const double peak_strain = stress.empty() ? 0.0 : strain[top - stress.begin()];
  for (int i = 0; i < kIntervals && !result.breaks.empty(); ++i)
    if (std::abs((i + 0.5) * width - peak_strain) < kPeakHalfWidth * result.failure_strain) peak[i] = 1.0;

  std::vector<double> density(kIntervals, (1.0 - kBreakShare - kFallShare - kPeakShare) / kIntervals);
  add_share(density, spread(breaks), kBreakShare);
  add_share(density, spread(falls), kFallShare);
  add_share(density, peak, kPeakShare);

  // Frame k lies where the k-th share of the whole density is to its left.
  double sum = 0.0;
  for (const double value : density) sum += value;
  std::vector<double> strains{0.0};
  double before = 0.0;
  std::size_t i = 0;
  for (int k = 1; k + 1 < count; ++k) {
    const double wanted = sum * k / (count - 1);
    while (before + density[i] < wanted) before += density[i++];
    strains.push_back((static_cast<double>(i) + (wanted - before) / density[i]) * width);
  }
  strains.push_back(result.failure_strain);
  return strains;
}

}  // namespace nacre::tester
