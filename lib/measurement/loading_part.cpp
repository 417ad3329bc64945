#include "measurement/loading_part.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/statistics.hpp"

namespace nacre::measurement {
namespace {

constexpr double kFrom = 0.1, kTo = 0.4;             // of the peak stress
constexpr double kStalled = 0.3, kJump = 3.0;        // of the expected strain of a stretch
constexpr std::size_t kFewestRows = 5, kFewest = 3;  // of a stretch; left out at least
constexpr double kBeyondNoise = 8.0;                 // standard deviations by which the strain grows along a stretch

double clock_at(const std::vector<double>& time_s, std::size_t row) {
  return time_s.empty() ? static_cast<double>(row) : time_s[row];
}

/// Slope of the strain over the clock by least squares; 0 where the clock stands.
double speed_of(const std::vector<double>& time_s, const tester::Curve& curve, Rise rise) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  const double origin = clock_at(time_s, rise.first);
  for (std::size_t i = rise.first; i <= rise.last; ++i) {
    const double t = clock_at(time_s, i) - origin, strain = curve.strain[i];
    n += 1.0;
    x += t;
    y += strain;
    xx += t * t;
    xy += t * strain;
  }
  const double spread = n * xx - x * x;
  return spread > 0.0 ? (n * xy - x * y) / spread : 0.0;
}

double middle_strain(const tester::Curve& curve, std::size_t begin, std::size_t end) {
  return quantile(std::vector<double>(curve.strain.begin() + static_cast<std::ptrdiff_t>(begin),
                                      curve.strain.begin() + static_cast<std::ptrdiff_t>(std::max(end, begin + 1))),
                  0.5);
}

/// The pull's first row in a stretch of which the beginning stands still or is taken back.
PullStart start_within(const std::vector<double>& time_s, const tester::Curve& curve, std::size_t begin,
                       std::size_t end, double speed) {
  double largest = 0.0;
  std::size_t jump = end;
  for (std::size_t i = begin + 1; i <= end; ++i) {
    const double step = std::abs(curve.strain[i] - curve.strain[i - 1]);
    if (step <= largest) continue;
    largest = step;
    jump = i;
  }
  const double duration = clock_at(time_s, end) - clock_at(time_s, begin);
  if (largest > kJump * speed * duration) return {.row = jump, .zero_strain = curve.strain[jump], .was_tared = true};
  const double hold = middle_strain(curve, begin > end - begin ? begin - (end - begin) : 0, begin + 1);
  const double start = clock_at(time_s, end) - (curve.strain[end] - hold) / speed;
  std::size_t row = begin;
  while (row < end && clock_at(time_s, row) < start) ++row;
  return {.row = row, .zero_strain = hold};
}

}  // namespace

Rise rise_of(const tester::Curve& curve, double from, double to) {
  const auto peak = std::max_element(curve.stress_pa.begin(), curve.stress_pa.end());
  const double peak_pa = peak == curve.stress_pa.end() ? 0.0 : *peak;
  Rise rise;
  while (rise.last + 1 < curve.size() && curve.stress_pa[rise.last] < to * peak_pa) ++rise.last;
  rise.first = rise.last;
  while (rise.first > 0 && curve.stress_pa[rise.first] > from * peak_pa) --rise.first;
  return rise;
}

double noise_of(const std::vector<double>& values, std::size_t count) {
  constexpr double kMedianOfNormal = 0.6745;
  std::vector<double> bends;
  for (std::size_t i = 1; i + 1 < count; ++i)
    bends.push_back(std::abs(values[i - 1] - 2.0 * values[i] + values[i + 1]));
  return bends.empty() ? 0.0 : quantile(std::move(bends), 0.5) / (kMedianOfNormal * std::sqrt(6.0));
}

PullStart pull_start(const std::vector<double>& time_s, const tester::Curve& curve) {
  if (curve.size() < 2 * kFewestRows) return {};
  const Rise rise = rise_of(curve, kFrom, kTo);
  if (rise.last - rise.first < 2) return {};
  const double speed = speed_of(time_s, curve, rise);
  if (!(speed > 0.0)) return {};
  const double step = speed * (clock_at(time_s, rise.last) - clock_at(time_s, rise.first)) /
                      static_cast<double>(rise.last - rise.first);
  const auto beyond_noise = static_cast<std::size_t>(
      std::min(kBeyondNoise * noise_of(curve.strain, rise.last + 1) / step, static_cast<double>(rise.last)));
  const std::size_t stretch = std::max({kFewestRows, (rise.last - rise.first) / 3, beyond_noise});
  for (std::size_t end = rise.first; end > 0;) {
    std::size_t begin = end > stretch ? end - stretch : 0;
    while (begin > 0 && clock_at(time_s, begin) == clock_at(time_s, end)) --begin;
    const double expected = speed * (clock_at(time_s, end) - clock_at(time_s, begin));
    const double strained = curve.strain[end] - curve.strain[begin];
    if (expected > 0.0 && end - begin >= kFewest && (strained < kStalled * expected || strained > kJump * expected)) {
      const PullStart start = start_within(time_s, curve, begin, end, speed);
      return start.row >= kFewest ? start : PullStart{};
    }
    end = begin;
  }
  return {};
}

}  // namespace nacre::measurement
