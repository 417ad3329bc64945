#include "measurement/reduction.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/statistics.hpp"
#include "measurement/loading_part.hpp"

namespace nacre::measurement {
namespace {

constexpr double kWindow = 0.2, kHighestStart = 0.6, kHighestEnd = 0.8, kStartStep = 0.02;  // of the peak stress
constexpr double kLongestWindow = 0.02;  // strain: a soft coupon locks within a fifth of its peak stress
constexpr double kStartStepStrain = 0.1 * kLongestWindow;
constexpr double kStraight = 0.01;  // share by which the halves of a straight part may differ in slope
constexpr double kVague = 0.2;      // standard error over slope above which a part may be slack
// Standard errors up to which a bend is taken for noise. A missed toe lowers the modulus, a missed straight part costs
// only points; if noise shortened windows, it would select among their slopes.
constexpr double kErrorsOfToe = 0.5, kErrorsOfBend = 1.0, kErrorsWhileVague = 2.5;
constexpr double kWidened = 1.25;        // factor by which a window is widened at once
constexpr double kSeparated = 0.02;      // of the peak stress
constexpr double kMostGivenBack = 0.05;  // of the largest strain: noise and recoil of the grips
constexpr double kNoisy = 0.2;           // noise of the strain over its step above which rows are not ordered by it
constexpr double kWithinNoise = 6.0;     // standard deviations below the largest strain
constexpr std::size_t kFewestPoints = 3, kEnoughPoints = 5;

struct FittedLine {
  double slope = 0.0, slope_error = 0.0;
  double zero = 0.0;
};

/// Sums over the first points of a path, about its middle: they make the fit of any window a matter of differences.
struct Sums {
  long double x = 0.0L, y = 0.0L, xx = 0.0L, xy = 0.0L, yy = 0.0L;
};

/// First loading: the part of a curve before its peak without loops of unloading.
struct FirstLoading {
  std::vector<std::size_t> index;  ///< of the curve
  std::vector<double> strain, stress_pa;
  std::vector<double> risen;     ///< isotonic regression of the strain
  std::vector<double> risen_pa;  ///< isotonic regression of the stress: the nearest that never falls
  std::vector<Sums> sums;        ///< before each point, and of all
  double middle = 0.0, middle_pa = 0.0;
  double strain_noise = 0.0, stress_noise_pa = 0.0;  ///< standard deviations; 0 where the strain has none to speak of
  std::size_t size() const { return index.size(); }
  double peak_pa() const { return risen_pa.back(); }
};

/// Isotonic regression by pooling adjacent violators: a level that noise crosses repeatedly is then reached once.
std::vector<double> nearest_rising(const std::vector<double>& values) {
  struct PooledBlock {
    double sum;
    std::size_t count;
    double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<PooledBlock> blocks;
  for (const double value : values) {
    PooledBlock block{value, 1};
    while (!blocks.empty() && blocks.back().mean() >= block.mean()) {
      block = {block.sum + blocks.back().sum, block.count + blocks.back().count};
      blocks.pop_back();
    }
    blocks.push_back(block);
  }
  std::vector<double> rising;
  for (const PooledBlock& block : blocks) rising.insert(rising.end(), block.count, block.mean());
  return rising;
}

/// Rows of first loading: every one whose strain exceeds the earlier ones; where the strain is noisy, every one that is
/// not below them by more than noise. Only the highest of noisy rows would lean to one side.
FirstLoading first_loading(const tester::Curve& curve, std::size_t peak) {
  FirstLoading path;
  const double noise = noise_of(curve.strain, peak + 1);
  const double range =
      *std::max_element(curve.strain.begin(), curve.strain.begin() + static_cast<std::ptrdiff_t>(peak) + 1) -
      curve.strain.front();
  if (noise > kNoisy * std::abs(range) / static_cast<double>(peak + 1)) {
    path.strain_noise = noise;
    path.stress_noise_pa = noise_of(curve.stress_pa, peak + 1);
  }
  double largest = 0.0;
  for (std::size_t i = 0; i <= peak; ++i) {
    if (path.size() > 0 && curve.strain[i] <= largest - kWithinNoise * path.strain_noise) continue;
    largest = path.size() > 0 ? std::max(largest, curve.strain[i]) : curve.strain[i];
    path.index.push_back(i);
    path.strain.push_back(curve.strain[i]);
    path.stress_pa.push_back(curve.stress_pa[i]);
  }
  path.risen_pa = nearest_rising(path.stress_pa);
  path.risen = nearest_rising(path.strain);
  path.middle = mean(path.strain);
  path.middle_pa = mean(path.stress_pa);
  path.sums.resize(path.size() + 1);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const long double x = path.strain[i] - path.middle, y = path.stress_pa[i] - path.middle_pa;
    const Sums& before = path.sums[i];
    path.sums[i + 1] = {before.x + x, before.y + y, before.xx + x * x, before.xy + x * y, before.yy + y * y};
  }
  return path;
}

/// Points first..last of a loading.
struct SlopeWindow {
  std::size_t first = 0, last = 0;
  std::size_t points() const { return last - first + 1; }
};

/// Deming regression where the strain is noisy (errors in both, their ratio from the record), else least squares. The
/// slope's error is that of its residuals.
FittedLine fit(const FirstLoading& path, SlopeWindow window) {
  const Sums &before = path.sums[window.first], &after = path.sums[window.last + 1];
  const long double count = static_cast<long double>(window.points());
  const long double x = after.x - before.x, y = after.y - before.y;
  const long double xx = std::max(after.xx - before.xx - x * x / count, 0.0L);
  const long double yy = std::max(after.yy - before.yy - y * y / count, 0.0L);
  const long double xy = after.xy - before.xy - x * y / count;
  constexpr long double kRounding = 1e-15L;  // of the products of the whole path
  if (std::abs(xy) <= kRounding * std::sqrt(path.sums.back().xx * path.sums.back().yy))
    return {0.0, static_cast<double>(count > 2.0L ? std::sqrt(yy / (count - 2.0L) / xx) : 0.0L), 0.0};
  long double slope = xy / xx;
  if (path.strain_noise > 0.0) {
    const long double ratio = std::pow(path.stress_noise_pa / path.strain_noise, 2.0);
    const long double half = yy - ratio * xx;
    slope = (half + std::sqrt(half * half + 4.0L * ratio * xy * xy)) / (2.0L * xy);
  }
  const long double unexplained = std::max(xx * yy / (xy * xy) - 1.0L, 0.0L);
  const long double error = count > 2.0L ? std::abs(slope) * std::sqrt(unexplained / (count - 2.0L)) : 0.0L;
  const long double zero = path.middle + x / count - (path.middle_pa + y / count) / slope;
  return {static_cast<double>(slope), static_cast<double>(error), static_cast<double>(zero)};
}

/// How much steeper the second half of a window is than the first, over the slope of the whole, and the standard error
/// of that.
struct Bend {
  double steeper = 0.0, error = 0.0;
  /// Its part beyond so many standard errors.
  double beyond(double errors) const {
    return std::copysign(std::max(0.0, std::abs(steeper) - errors * error), steeper);
  }
};

Bend bend_of(const FirstLoading& path, SlopeWindow window) {
  const std::size_t middle = window.first + (window.last - window.first) / 2;
  const FittedLine first = fit(path, {window.first, middle}), second = fit(path, {middle, window.last});
  const double slope = std::abs(fit(path, window).slope);
  return {(second.slope - first.slope) / slope, std::hypot(first.slope_error, second.slope_error) / slope};
}

/// Windows on first loading.
class Windows {
 public:
  explicit Windows(const FirstLoading& path)
      : path_(path), end_(std::min(reached(kHighestEnd * path.peak_pa()), path.size() - 1)) {}

  /// A fifth of the peak stress or 2 % strain, whichever is shorter, made longer while straight until its slope is
  /// known to 1 %.
  std::optional<SlopeWindow> from(std::size_t first) const {
    const std::size_t enough = std::min(reached(path_.risen_pa[first] + kWindow * path_.peak_pa()),
                                        strained(path_.risen[first] + kLongestWindow));
    SlopeWindow window{first, std::min(std::max(enough, first + kEnoughPoints - 1), path_.size() - 1)};
    if (window.points() < kFewestPoints) return std::nullopt;
    const auto is_vague = [&] {
      const FittedLine line = fit(path_, window);
      return line.slope_error > kSureModulus * line.slope;
    };
    while (window.last < end_ && is_vague() &&
           std::abs(bend_of(path_, widened(window)).beyond(kErrorsWhileVague)) <= kStraight)
      window = widened(window);
    return window;
  }

  /// The same, made longer as long as its second half is as steep as its first.
  SlopeWindow straight(SlopeWindow window) const {
    while (window.last < end_ && bend_of(path_, widened(window)).beyond(kErrorsOfBend) >= -kStraight)
      window = widened(window);
    return window;
  }

  std::size_t next(std::size_t first) const {
    return std::max(first + 1, std::min(reached(path_.risen_pa[first] + kStartStep * path_.peak_pa()),
                                        strained(path_.risen[first] + kStartStepStrain)));
  }

 private:
  static std::size_t first_at(const std::vector<double>& rising, double level) {
    return static_cast<std::size_t>(std::lower_bound(rising.begin(), rising.end(), level) - rising.begin());
  }
  std::size_t reached(double stress_pa) const { return first_at(path_.risen_pa, stress_pa); }
  std::size_t strained(double strain) const { return first_at(path_.risen, strain); }
  SlopeWindow widened(SlopeWindow window) const {
    const auto longer = static_cast<std::size_t>(kWidened * static_cast<double>(window.points()));
    return {window.first, std::min(std::max(window.first + longer, window.last + 1), end_)};
  }

  const FirstLoading& path_;
  std::size_t end_;
};

/// The first window beyond the toe: its second half is not steeper than its first, and it rises by more than noise.
/// Without such a window, the one that steepens least. Nothing where the curve does not rise.
std::optional<SlopeWindow> first_plateau(const FirstLoading& path) {
  const Windows windows(path);
  std::optional<SlopeWindow> straightest;
  double least = 0.0;
  for (std::size_t first = 0; first < path.size() && path.risen_pa[first] <= kHighestStart * path.peak_pa();
       first = windows.next(first)) {
    const auto window = windows.from(first);
    if (!window) break;
    const FittedLine line = fit(path, *window);
    if (!(line.slope > 0.0)) continue;
    const double growth = std::max(0.0, bend_of(path, *window).beyond(kErrorsOfToe));
    if (growth <= kStraight && line.slope_error <= kVague * line.slope) return windows.straight(*window);
    if (straightest && growth >= least) continue;
    straightest = window;
    least = growth;
  }
  return straightest;
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

/// Whether the strain returned before the low stress at `end`: the specimen was unloaded, not separated.
bool is_unloaded(const tester::Curve& curve, std::size_t end) {
  return curve.strain[end] < (1.0 - kMostGivenBack) * largest_strain(curve, end);
}

/// Origin of strain. A line that meets zero stress before the record began means a preload, as the first stress tells,
/// or a bent curve, which shifts nothing.
double toe_of(const tester::Curve& curve, const LinearPart& part) {
  return std::max(part.zero_strain, std::min(0.0, -curve.stress_pa.front() / part.slope_pa));
}

/// The curve with strain counted from `toe_strain`; the toe before the linear part is replaced by the extrapolated
/// line.
tester::Curve compensated(const tester::Curve& curve, const LinearPart& part, double toe_strain) {
  const std::size_t begin = toe_strain > 0.0 ? part.first : 0;
  tester::Curve shifted;
  if (curve.strain[begin] > toe_strain) {
    shifted.strain.push_back(0.0);
    shifted.stress_pa.push_back(0.0);
  }
  for (std::size_t i = begin; i < curve.size(); ++i) {
    shifted.strain.push_back(curve.strain[i] - toe_strain);
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
  const FirstLoading path = first_loading(curve, peak);
  if (path.size() < kFewestPoints)
    return fail("only {} points before the peak, expected a curve that rises", path.size());
  const std::optional<SlopeWindow> part = first_plateau(path);
  if (!part) return fail("no straight part before the peak, expected a curve that rises");
  const FittedLine line = fit(path, *part);
  return LinearPart{line.slope, line.slope_error, line.zero, path.index[part->first], path.index[part->last]};
}

Result<ReducedTest> reduce(const tester::Curve& curve, Toe toe) {
  const Result<LinearPart> part = linear_part(curve);
  if (!part) return tl::unexpected(part.error());
  ReducedTest test;
  test.modulus_pa = part->slope_pa;
  test.modulus_error_pa = part->slope_error_pa;
  test.straight_from_pa = curve.stress_pa[part->first];
  test.straight_to_pa = curve.stress_pa[part->last];
  const double found = toe == Toe::compensate ? toe_of(curve, *part) : 0.0;
  const bool is_small = std::abs(found) <= kLargestToe;
  (is_small ? test.toe_strain : test.toe_kept) = found;
  test.curve = toe == Toe::compensate && is_small ? compensated(curve, *part, found) : curve;
  const auto& stress = test.curve.stress_pa;
  const auto peak = static_cast<std::size_t>(std::max_element(stress.begin(), stress.end()) - stress.begin());
  test.peak_stress_pa = stress[peak];
  test.residual_share = stress.back() / stress[peak];
  if (const double line_pa = test.modulus_pa * test.curve.strain[peak]; line_pa > 0.0)
    test.stiffening = stress[peak] / line_pa;
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

}  // namespace nacre::measurement
