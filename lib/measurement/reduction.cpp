#include "measurement/reduction.hpp"

#include <algorithm>
#include <cmath>

namespace nacre::measurement {
namespace {

constexpr double kWindow = 0.2, kHighestWindow = 0.6, kWindowStep = 0.02;  // of the peak stress
constexpr double kAsSteep = 0.98;
constexpr double kSeparated = 0.02;      // of the peak stress
constexpr double kMostGivenBack = 0.05;  // of the largest strain: noise and recoil of the grips
constexpr std::size_t kFewestPoints = 3, kEnoughPoints = 5;

struct Line {
  double slope = 0.0;
  double zero = 0.0;
};

/// Least squares through points first..last of `path`, indices of the curve.
std::optional<Line> fit(const tester::Curve& curve, const std::vector<std::size_t>& path, std::size_t first,
                        std::size_t last) {
  const double count = static_cast<double>(last - first + 1);
  double mean_strain = 0.0, mean_stress = 0.0, squares = 0.0, products = 0.0;
  for (std::size_t k = first; k <= last; ++k) {
    mean_strain += curve.strain[path[k]] / count;
    mean_stress += curve.stress_pa[path[k]] / count;
  }
  for (std::size_t k = first; k <= last; ++k) {
    const double strain = curve.strain[path[k]] - mean_strain;
    squares += strain * strain;
    products += strain * (curve.stress_pa[path[k]] - mean_stress);
  }
  if (squares <= 0.0 || products <= 0.0) return std::nullopt;
  const double slope = products / squares;
  return Line{slope, mean_strain - mean_stress / slope};
}

/// Indices up to the peak along which strain is larger than ever before: loops of unloading are left out.
std::vector<std::size_t> first_loading(const tester::Curve& curve, std::size_t peak) {
  std::vector<std::size_t> path;
  for (std::size_t i = 0; i <= peak; ++i) {
    if (path.empty() || curve.strain[i] > curve.strain[path.back()]) path.push_back(i);
  }
  return path;
}

struct Window {
  std::size_t first = 0, last = 0;
  double slope = 0.0;
};

/// The window from `low` of the peak on, made longer until it holds five points; nothing at the end of the path.
std::optional<Window> window_at(const tester::Curve& curve, const std::vector<std::size_t>& path, double low,
                                double peak_pa) {
  const auto reached = [&](double stress_pa) {
    std::size_t k = 0;
    while (k < path.size() && curve.stress_pa[path[k]] < stress_pa) ++k;
    return k;
  };
  Window window{reached(low * peak_pa), 0, 0.0};
  window.last =
      std::min(std::max(reached((low + kWindow) * peak_pa), window.first + kEnoughPoints - 1), path.size() - 1);
  if (window.last < window.first + kFewestPoints - 1) return std::nullopt;
  const auto line = fit(curve, path, window.first, window.last);
  if (!line) return std::nullopt;
  window.slope = line->slope;
  return window;
}

/// First index after the peak from which the stress stays at or below 2 % of it; the curve's size when there is none.
std::size_t release(const tester::Curve& curve, std::size_t peak) {
  const double limit_pa = kSeparated * curve.stress_pa[peak];
  std::size_t end = curve.size();
  while (end > peak + 1 && curve.stress_pa[end - 1] <= limit_pa) --end;
  return end;
}

double largest_strain(const tester::Curve& curve, std::size_t end) {
  return *std::max_element(curve.strain.begin(), curve.strain.begin() + static_cast<std::ptrdiff_t>(end));
}

/// Whether the specimen gave its strain back on the way to the low stress at `end`: it was unloaded, not torn apart.
bool is_unloaded(const tester::Curve& curve, std::size_t end) {
  return curve.strain[end] < (1.0 - kMostGivenBack) * largest_strain(curve, end);
}

/// The curve from the linear part on, strain counted from where that part meets zero stress.
tester::Curve compensated(const tester::Curve& curve, const LinearPart& part) {
  tester::Curve shifted;
  if (curve.strain[part.first] > part.zero_strain) {
    shifted.strain.push_back(0.0);
    shifted.stress_pa.push_back(0.0);
  }
  for (std::size_t i = part.first; i < curve.size(); ++i) {
    shifted.strain.push_back(curve.strain[i] - part.zero_strain);
    shifted.stress_pa.push_back(curve.stress_pa[i]);
  }
  return shifted;
}

}  // namespace

tester::Curve forward_part(const tester::Curve& curve) {
  tester::Curve forward;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (!forward.empty() && curve.strain[i] <= forward.strain.back()) continue;
    forward.strain.push_back(curve.strain[i]);
    forward.stress_pa.push_back(curve.stress_pa[i]);
  }
  return forward;
}

Result<LinearPart> linear_part(const tester::Curve& curve) {
  if (curve.size() < kFewestPoints) return fail("{} points, expected at least {}", curve.size(), kFewestPoints);
  const auto peak = static_cast<std::size_t>(std::max_element(curve.stress_pa.begin(), curve.stress_pa.end()) -
                                             curve.stress_pa.begin());
  const double peak_pa = curve.stress_pa[peak];
  if (-*std::min_element(curve.stress_pa.begin(), curve.stress_pa.end()) > peak_pa)
    return fail("tension counts as positive: the force is negative, expected an export with its sign reversed");
  if (peak_pa <= 0.0) return fail("the force never becomes positive, expected tension to count as positive");
  const std::vector<std::size_t> path = first_loading(curve, peak);
  std::vector<Window> windows;
  for (double low = 0.0; low <= kHighestWindow + 1e-9; low += kWindowStep) {
    if (const auto window = window_at(curve, path, low, peak_pa)) windows.push_back(*window);
  }
  if (windows.empty()) return fail("only {} points on the way to the peak, expected a curve that rises", path.size());
  const auto steeper = [](const Window& a, const Window& b) { return a.slope < b.slope; };
  const auto steepest = std::max_element(windows.begin(), windows.end(), steeper);
  auto begin = steepest, end = steepest;
  while (begin != windows.begin() && std::prev(begin)->slope >= kAsSteep * steepest->slope) --begin;
  while (std::next(end) != windows.end() && std::next(end)->slope >= kAsSteep * steepest->slope) ++end;
  const auto line = fit(curve, path, begin->first, end->last);
  if (!line) return fail("no straight part on the way to the peak, expected a curve that rises");
  return LinearPart{line->slope, line->zero, path[begin->first], path[end->last]};
}

Result<ReducedTest> reduce(const tester::Curve& curve, Toe toe) {
  const Result<LinearPart> part = linear_part(curve);
  if (!part) return tl::unexpected(part.error());
  ReducedTest test;
  test.modulus_pa = part->slope_pa;
  test.curve = toe == Toe::compensate ? compensated(curve, *part) : curve;
  test.toe_strain = toe == Toe::compensate ? part->zero_strain : 0.0;
  const auto& stress = test.curve.stress_pa;
  const auto peak = static_cast<std::size_t>(std::max_element(stress.begin(), stress.end()) - stress.begin());
  test.peak_stress_pa = stress[peak];
  test.residual_share = stress.back() / stress[peak];
  const std::size_t end = release(test.curve, peak);
  test.unloaded = end < test.curve.size() && is_unloaded(test.curve, end);
  test.separated = end < test.curve.size() && !test.unloaded;
  if (test.separated) {
    test.curve.strain.resize(end + 1);
    test.curve.stress_pa.resize(end + 1);
  }
  test.failure_strain = test.separated ? test.curve.strain.back() : largest_strain(test.curve, test.curve.size());
  test.toughness_pa = tester::area_under(test.curve);
  return test;
}

std::optional<double> strain_rate(const std::vector<double>& time_s, const std::vector<double>& strain) {
  std::vector<double> rates;
  for (std::size_t i = 1; i < std::min(time_s.size(), strain.size()); ++i) {
    const double passed_s = time_s[i] - time_s[i - 1];
    if (passed_s > 0.0) rates.push_back(std::abs(strain[i] - strain[i - 1]) / passed_s);
  }
  if (rates.empty()) return std::nullopt;
  const auto middle = rates.begin() + static_cast<std::ptrdiff_t>(rates.size() / 2);
  std::nth_element(rates.begin(), middle, rates.end());
  return *middle > 0.0 ? std::optional(*middle) : std::nullopt;
}

}  // namespace nacre::measurement
