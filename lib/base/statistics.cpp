#include "base/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace nacre {
double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double root_mean_square(std::span<const double> values, int lost) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / (static_cast<double>(values.size()) - lost));
}

double standard_deviation(std::span<const double> values) {
  if (values.size() < 2) return 0.0;
  const double middle = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - middle) * (value - middle);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double range_of(std::span<const double> values) {
  if (values.empty()) return 0.0;
  const auto [least, most] = std::ranges::minmax_element(values);
  return *most - *least;
}

double quantile(std::vector<double> values, double share) {
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = values.begin() + std::min(static_cast<std::ptrdiff_t>(place), std::ssize(values) - 1);
  std::nth_element(values.begin(), below, values.end());
  if (below + 1 == values.end()) return *below;
  return std::lerp(*below, *std::min_element(below + 1, values.end()), place - std::floor(place));
}

std::vector<double> ranks_of(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last + 1 < order.size() && values[order[last + 1]] == values[order[first]]) ++last;
    const double shared = 1.0 + 0.5 * static_cast<double>(first + last);
    for (std::size_t i = first; i <= last; ++i) ranks[order[i]] = shared;
    first = last + 1;
  }
  return ranks;
}

double rank_correlation(std::span<const double> a, std::span<const double> b) {
  if (a.size() < 3) return 0.0;
  const std::vector<double> rank_a = ranks_of(a), rank_b = ranks_of(b);
  const double middle = 0.5 * (1.0 + static_cast<double>(a.size()));
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (rank_a[i] - middle) * (rank_b[i] - middle);
    aa += (rank_a[i] - middle) * (rank_a[i] - middle);
    bb += (rank_b[i] - middle) * (rank_b[i] - middle);
  }
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

double student_beyond(double t, int degrees) {
  const double angle = std::atan(std::abs(t) / std::sqrt(degrees)), cosine = std::cos(angle);
  double sum = 0.0, term = degrees % 2 == 0 ? 1.0 : cosine;
  for (int k = degrees % 2; k <= degrees - 2; k += 2) {
    sum += term;
    term *= cosine * cosine * (k + 1.0) / (k + 2.0);
  }
  const double within = std::sin(angle) * sum;
  const double share = degrees % 2 == 0 ? within : 2.0 / std::numbers::pi * (angle + within);
  return std::clamp(1.0 - share, 0.0, 1.0);
}

double student_quantile(double chance, int degrees) {
  double low = 0.0, high = 1e4;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (student_beyond(middle, degrees) > chance ? low : high) = middle;
  }
  return high;
}

}  // namespace nacre
