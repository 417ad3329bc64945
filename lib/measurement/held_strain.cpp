#include "measurement/held_strain.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::measurement {
namespace {

constexpr double kStandsStill = 0.02;  // of the strain
constexpr std::size_t kFewestHeldRows = 5;

/// Times 10^(k/2) s between the first and the last.
std::vector<double> round_times(double first_s, double last_s) {
  std::vector<double> times;
  for (int k = static_cast<int>(std::ceil(2.0 * std::log10(first_s) - 1e-9));; ++k) {
    const double time_s = std::pow(10.0, 0.5 * k);
    if (time_s > last_s * (1.0 + 1e-9)) return times;
    times.push_back(time_s);
  }
}

/// The curve at a time: the mean of what is near, else between its neighbours.
RelaxationReading reading_at(const std::vector<RelaxationReading>& readings, double time_s) {
  constexpr double kNear = 1.12;
  const auto by_time = [](const RelaxationReading& each, double time) { return each.time_s < time; };
  const auto from = std::lower_bound(readings.begin(), readings.end(), time_s / kNear, by_time),
             to = std::lower_bound(readings.begin(), readings.end(), time_s * kNear, by_time);
  if (from == to) {
    const RelaxationReading &below = *std::prev(from), &above = *from;
    const double share = std::log(time_s / below.time_s) / std::log(above.time_s / below.time_s);
    return {above.line, time_s, below.modulus_pa * std::pow(above.modulus_pa / below.modulus_pa, share)};
  }
  double sum = 0.0;
  for (auto each = from; each != to; ++each) sum += std::log(each->modulus_pa);
  return {from[(to - from) / 2].line, time_s, std::exp(sum / static_cast<double>(to - from))};
}

}  // namespace

std::optional<HeldStretch> held_stretch(const std::vector<double>& time_s, const std::vector<double>& strain) {
  HeldStretch longest;
  for (std::size_t first = 0; first < strain.size();) {
    std::size_t end = first + 1;
    while (end < strain.size() && std::abs(strain[end] - strain[first]) <= kStandsStill * std::abs(strain[first]))
      ++end;
    if (end - first > longest.end - longest.first && strain[first] > 0.0)
      longest = {.first = first, .end = end, .strain = strain[(first + end) / 2]};
    first = std::max(end, first + 1);
  }
  if (longest.end - longest.first < kFewestHeldRows) return std::nullopt;
  // The ramp ends a little before the strain stands still.
  while (longest.first > 0 && std::abs(strain[longest.first - 1] - longest.strain) <= kStandsStill * longest.strain)
    --longest.first;
  while (longest.first + kFewestHeldRows < longest.end &&
         std::abs(strain[longest.first] - longest.strain) > kStandsStill * longest.strain)
    ++longest.first;
  if (longest.is_whole()) return longest;
  std::size_t begin = longest.first;
  while (begin > 0 && strain[begin] > kStandsStill * longest.strain) --begin;
  longest.ramp_s = time_s[longest.first] - time_s[begin];
  longest.begin_s = 0.5 * (time_s[longest.first] + time_s[begin]);
  return longest;
}

bool is_relaxation(const HeldStretch& held, const std::vector<double>& time_s) {
  constexpr double kLonger = 5.0;
  return held.end == time_s.size() && !held.is_whole() &&
         time_s[held.end - 1] - time_s[held.first] >= kLonger * held.ramp_s;
}

std::vector<RelaxationReading> thinned(const std::vector<RelaxationReading>& readings) {
  constexpr std::size_t kMostAsTheyAre = 10;
  if (readings.size() <= kMostAsTheyAre) return readings;
  const double first_s = readings.front().time_s, last_s = readings.back().time_s;
  std::vector<double> times = round_times(first_s, last_s);
  if (times.size() < 2) times = {first_s, std::sqrt(first_s * last_s), last_s};
  std::vector<RelaxationReading> few;
  for (const double time_s : times) few.push_back(reading_at(readings, time_s));
  return few;
}

}  // namespace nacre::measurement
