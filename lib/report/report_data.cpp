#include "report/report_data.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "material/extensions.hpp"

namespace nacre::report {
namespace {

/// The constant c with the least mean of |c - v| / v: the median of v weighted by 1 / v.
double least_relative_error_constant(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  double total = 0.0, below = 0.0;
  for (const double value : sorted) total += 1.0 / value;
  for (const double value : sorted) {
    below += 1.0 / value;
    if (below >= 0.5 * total) return value;
  }
  return sorted.back();
}

/// Mean relative error of y predicted by a straight line in x through the other designs (least squares of the relative
/// errors); nothing when they share one x.
std::optional<double> left_out_line_error(std::span<const double> x, std::span<const double> y) {
  double sum_w = 0.0, mean_x = 0.0, mean_y = 0.0, sxx = 0.0, sxy = 0.0;
  const auto weight = [&](std::size_t i) { return 1.0 / (y[i] * y[i]); };
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum_w += weight(i);
    mean_x += weight(i) * x[i];
    mean_y += weight(i) * y[i];
  }
  mean_x /= sum_w;
  mean_y /= sum_w;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sxx += weight(i) * (x[i] - mean_x) * (x[i] - mean_x);
    sxy += weight(i) * (x[i] - mean_x) * (y[i] - mean_y);
  }
  const bool shares_one_x = std::all_of(x.begin(), x.end(), [&](double each) { return each == x.front(); });
  if (x.size() < 3 || shares_one_x) return std::nullopt;
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double leverage = weight(i) * (1.0 / sum_w + (x[i] - mean_x) * (x[i] - mean_x) / sxx);
    if (leverage > 1.0 - 1e-9) return std::nullopt;  // without this design the others share one x
    const double residual = y[i] - (mean_y + sxy / sxx * (x[i] - mean_x));
    sum += std::abs(residual / (1.0 - leverage)) / y[i];
  }
  return sum / static_cast<double>(x.size());
}

/// Largest `value` at which the polyline passes `position`; members say which coordinate is which.
std::optional<double> line_at(std::span<const optimize::Performance> line, double optimize::Performance::*position_of,
                              double optimize::Performance::*value_of, double position) {
  std::optional<double> best;
  const auto offer = [&](double value) { best = std::max(best.value_or(value), value); };
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double p0 = line[i].*position_of, p1 = line[i + 1].*position_of;
    const double v0 = line[i].*value_of, v1 = line[i + 1].*value_of;
    if (position < std::min(p0, p1) || position > std::max(p0, p1)) continue;
    offer(p0 == p1 ? std::max(v0, v1) : v0 + (v1 - v0) * (position - p0) / (p1 - p0));
  }
  return best;
}

}  // namespace

std::vector<optimize::Performance> newest_line(const run::RunRecord& run) {
  for (auto round = run.rounds.rbegin(); round != run.rounds.rend(); ++round) {
    if (const auto line = run::line_as_measured(round->second); !line.empty()) return line;
  }
  return {};
}

Baselines baselines(std::span<const double> rigid_fraction, std::span<const double> modulus_pa,
                    std::span<const double> toughness_pa) {
  Baselines result;
  result.count = static_cast<int>(rigid_fraction.size());
  const auto positive = [](double value) { return value > 0.0; };
  if (toughness_pa.size() > 1 && std::all_of(toughness_pa.begin(), toughness_pa.end(), positive)) {
    result.toughness_pa = least_relative_error_constant(toughness_pa);
    double sum = 0.0;
    for (const double toughness : toughness_pa) sum += std::abs(result.toughness_pa - toughness) / toughness;
    result.constant_toughness = sum / static_cast<double>(toughness_pa.size());
  }
  if (modulus_pa.size() >= 3 && std::all_of(modulus_pa.begin(), modulus_pa.end(), positive)) {
    result.linear_modulus = left_out_line_error(rigid_fraction, modulus_pa);
  }
  return result;
}

Baselines baselines(std::span<const MeasuredPattern> patterns) {
  std::vector<double> fraction, modulus, toughness;
  for (const MeasuredPattern& p : patterns) {
    fraction.push_back(p.pattern.rigid_fraction());
    modulus.push_back(p.mean.modulus_pa);
    toughness.push_back(p.mean.toughness_pa);
  }
  return baselines(fraction, modulus, toughness);
}

Improvement improvement_over(std::span<const optimize::Performance> line, const optimize::Performance& design) {
  using optimize::Performance;
  Improvement improvement;
  const auto modulus = line_at(line, &Performance::toughness_pa, &Performance::modulus_pa, design.toughness_pa);
  const auto toughness = line_at(line, &Performance::modulus_pa, &Performance::toughness_pa, design.modulus_pa);
  if (modulus && *modulus > 0.0) improvement.modulus = design.modulus_pa / *modulus;
  if (toughness && *toughness > 0.0) improvement.toughness = design.toughness_pa / *toughness;
  return improvement;
}

std::vector<optimize::Performance> thinned(std::span<const optimize::Performance> points, std::size_t most) {
  if (points.size() <= most) return {points.begin(), points.end()};
  std::vector<optimize::Performance> kept = optimize::pareto_front(points);
  const std::size_t stride = (points.size() + most - 1) / most;
  for (std::size_t i = 0; i < points.size(); i += stride) kept.push_back(points[i]);
  return kept;
}

const MeasuredPattern* find_measured(std::span<const MeasuredPattern> patterns, std::string_view design) {
  const auto found = std::find_if(patterns.begin(), patterns.end(),
                                  [&](const MeasuredPattern& p) { return p.pattern.key() == design; });
  return found == patterns.end() ? nullptr : &*found;
}

}  // namespace nacre::report
