#include "measurement/strain_rate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "measurement/loading_part.hpp"

namespace nacre::measurement {
namespace {

constexpr double kSureRate = 0.01;              // standard error over the rate, up to which no more ticks are taken
constexpr double kOwnNoise = 1.5;               // residuals over the noise of the strain along one speed
constexpr double kStill = 0.25, kMoving = 0.5;  // of a rate
constexpr double kSureOfHold = 3.0;             // standard errors
constexpr std::size_t kStretches = 4;           // of the window of the rate
constexpr std::size_t kFewestTicks = 3, kEnoughTicks = 5;

/// Rows at which the clock advances, up to the end of the record.
struct Ticks {
  std::vector<double> time_s, strain;
  tester::Curve to_peak;
};

/// First to last of the ticks.
struct TickWindow {
  std::size_t first = 0, last = 0;
  std::size_t count() const { return last - first + 1; }
};

struct FittedRate {
  double rate_per_s = 0.0, error_per_s = 0.0;
  double residual = 0.0;  ///< standard deviation of the strain about the line
};

Ticks ticks_of(const std::vector<double>& time_s, const tester::Curve& curve) {
  Ticks ticks;
  const auto peak = static_cast<std::size_t>(std::max_element(curve.stress_pa.begin(), curve.stress_pa.end()) -
                                             curve.stress_pa.begin());
  for (std::size_t i = 0; i < std::min(time_s.size(), curve.size()); ++i) {
    if (!ticks.time_s.empty() && time_s[i] <= ticks.time_s.back()) continue;
    ticks.time_s.push_back(time_s[i]);
    ticks.strain.push_back(curve.strain[i]);
    if (i > peak) continue;
    ticks.to_peak.strain.push_back(curve.strain[i]);
    ticks.to_peak.stress_pa.push_back(curve.stress_pa[i]);
  }
  return ticks;
}

/// Least squares of strain over time.
FittedRate fitted_rate(const Ticks& ticks, TickWindow window) {
  const double count = static_cast<double>(window.count());
  double mean_time = 0.0, mean_strain = 0.0, squares = 0.0, products = 0.0, left = 0.0;
  for (std::size_t i = window.first; i <= window.last; ++i) {
    mean_time += ticks.time_s[i] / count;
    mean_strain += ticks.strain[i] / count;
  }
  for (std::size_t i = window.first; i <= window.last; ++i) {
    squares += std::pow(ticks.time_s[i] - mean_time, 2);
    products += (ticks.time_s[i] - mean_time) * (ticks.strain[i] - mean_strain);
  }
  const double rate = products / squares;
  for (std::size_t i = window.first; i <= window.last; ++i)
    left += std::pow(ticks.strain[i] - mean_strain - rate * (ticks.time_s[i] - mean_time), 2);
  const double residual = count > 2.0 ? std::sqrt(left / (count - 2.0)) : 0.0;
  return {rate, residual / std::sqrt(squares), residual};
}

/// The longest part of a window in which the strain moves at half of `rate` and more, judged over so many ticks that
/// noise does not hide the motion.
TickWindow longest_moving(const Ticks& ticks, TickWindow window, double rate, double noise) {
  constexpr double kBeyondNoise = 6.0;
  const double step =
      rate * (ticks.time_s[window.last] - ticks.time_s[window.first]) / static_cast<double>(window.last - window.first);
  const std::size_t along =
      std::max(kEnoughTicks,
               static_cast<std::size_t>(std::min(kBeyondNoise * noise / step, static_cast<double>(window.count()))));
  TickWindow longest{window.first, window.first};
  std::size_t begin = window.first;
  for (std::size_t i = window.first; i + along <= window.last; ++i) {
    const std::size_t next = i + along;
    if (ticks.strain[next] - ticks.strain[i] < kMoving * rate * (ticks.time_s[next] - ticks.time_s[i])) {
      begin = i + 1;
    } else if (next - begin > longest.last - longest.first) {
      longest = {begin, next};
    }
  }
  return longest;
}

/// Where a test was held in a window, the part in which it moved; else the window.
TickWindow without_hold(const Ticks& ticks, TickWindow window, double noise) {
  if (window.count() < 2 * kStretches * kEnoughTicks) return window;
  FittedRate slowest, fastest;
  for (std::size_t i = 0; i < kStretches; ++i) {
    const FittedRate rate = fitted_rate(ticks, {window.first + i * window.count() / kStretches,
                                                window.first + (i + 1) * window.count() / kStretches - 1});
    if (i == 0 || rate.rate_per_s < slowest.rate_per_s) slowest = rate;
    if (i == 0 || rate.rate_per_s > fastest.rate_per_s) fastest = rate;
  }
  const double doubt = kSureOfHold * std::hypot(slowest.error_per_s, kStill * fastest.error_per_s);
  if (slowest.rate_per_s + doubt > kStill * fastest.rate_per_s) return window;
  const TickWindow moving = longest_moving(ticks, window, fastest.rate_per_s, noise);
  return moving.count() >= kEnoughTicks ? moving : window;
}

}  // namespace

std::optional<double> strain_rate(const std::vector<double>& time_s, const tester::Curve& curve) {
  const Ticks ticks = ticks_of(time_s, curve);
  const std::size_t at_peak = ticks.to_peak.size();
  if (at_peak < kFewestTicks) return std::nullopt;
  std::vector<TickWindow> windows;
  for (const auto& [from, to] : std::array{std::pair(0.1, 0.4), std::pair(0.05, 0.6), std::pair(0.0, 1.0)}) {
    const Rise rise = rise_of(ticks.to_peak, from, to);
    windows.push_back({rise.first, rise.last});
  }
  windows.push_back({0, at_peak - 1});
  windows.push_back({windows[2].first, ticks.time_s.size() - 1});
  const double noise = noise_of(ticks.strain, at_peak);
  std::optional<FittedRate> known;
  for (const TickWindow& window : windows) {
    if (window.count() < (&window == &windows[3] ? kFewestTicks : kEnoughTicks)) continue;
    const FittedRate fitted = fitted_rate(ticks, without_hold(ticks, window, noise));
    if (known && fitted.residual > kOwnNoise * noise) continue;
    known = fitted;
    if (fitted.error_per_s <= kSureRate * std::abs(fitted.rate_per_s)) break;
  }
  const double rate_per_s = known ? std::abs(known->rate_per_s) : 0.0;
  return rate_per_s > 0.0 ? std::optional(rate_per_s) : std::nullopt;
}

}  // namespace nacre::measurement
