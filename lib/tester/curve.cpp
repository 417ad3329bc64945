#include "tester/curve.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace nacre::tester {
namespace {

/// Integral of |linear function| over an interval of that width, from its values at the ends.
double absolute_trapezoid(double width, double start, double end) {
  if (start * end >= 0.0) return 0.5 * width * (std::abs(start) + std::abs(end));
  return 0.5 * width * (start * start + end * end) / (std::abs(start) + std::abs(end));
}

/// A curve read from left to right: its value just after and just before any strain, zero outside, so that jumps count.
class CurveReader {
 public:
  explicit CurveReader(const Curve& curve) : curve_(curve) {}
  /// Values at both ends of the interval (left, right), which must lie between two neighbouring samples or outside.
  std::pair<double, double> across(double left, double right) {
    const std::vector<double>& strain = curve_.strain;
    if (curve_.empty() || right <= strain.front() || left >= strain.back()) return {0.0, 0.0};
    while (next_ < strain.size() && strain[next_] <= left) ++next_;
    return {value(left), value(right)};
  }

 private:
  double value(double strain) const {
    const double a = curve_.strain[next_ - 1], b = curve_.strain[next_];
    const double share = (strain - a) / (b - a);
    return curve_.stress_pa[next_ - 1] + share * (curve_.stress_pa[next_] - curve_.stress_pa[next_ - 1]);
  }
  const Curve& curve_;
  std::size_t next_ = 1;
};

}  // namespace

double area_under(const Curve& curve) {
  double area = 0.0;
  for (std::size_t i = 1; i < curve.size(); ++i)
    area += 0.5 * (curve.strain[i] - curve.strain[i - 1]) * (curve.stress_pa[i] + curve.stress_pa[i - 1]);
  return area;
}

double area_between(const Curve& a, const Curve& b) {
  std::vector<double> strains(a.size() + b.size());
  std::ranges::merge(a.strain, b.strain, strains.begin());
  CurveReader reader_a(a), reader_b(b);
  double area = 0.0;
  for (std::size_t i = 1; i < strains.size(); ++i) {
    const double left = strains[i - 1], right = strains[i];
    if (right <= left) continue;
    const auto [a_left, a_right] = reader_a.across(left, right);
    const auto [b_left, b_right] = reader_b.across(left, right);
    area += absolute_trapezoid(right - left, a_left - b_left, a_right - b_right);
  }
  return area;
}

double largest_difference(const Curve& a, const Curve& b, double until_strain) {
  double largest = 0.0, peak = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()) && a.strain[i] <= until_strain; ++i) {
    peak = std::max(peak, std::abs(a.stress_pa[i]));
    largest = std::max(largest, std::abs(a.stress_pa[i] - b.stress_pa[i]));
  }
  return peak > 0.0 ? largest / peak : 1.0;
}

double stress_at(const Curve& curve, double strain) {
  if (curve.empty() || strain < curve.strain.front() || strain > curve.strain.back()) return 0.0;
  const auto above = std::upper_bound(curve.strain.begin(), curve.strain.end(), strain);
  if (above == curve.strain.end()) return curve.stress_pa.back();
  const auto next = static_cast<std::size_t>(above - curve.strain.begin());
  const double share = (strain - curve.strain[next - 1]) / (curve.strain[next] - curve.strain[next - 1]);
  return curve.stress_pa[next - 1] + share * (curve.stress_pa[next] - curve.stress_pa[next - 1]);
}

Curve cut_at(const Curve& curve, double strain) {
  Curve result;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve.strain[i] > strain) {
      if (i > 0) {
        const double t = (strain - curve.strain[i - 1]) / (curve.strain[i] - curve.strain[i - 1]);
        result.strain.push_back(strain);
        result.stress_pa.push_back(curve.stress_pa[i - 1] + t * (curve.stress_pa[i] - curve.stress_pa[i - 1]));
      }
      break;
    }
    result.strain.push_back(curve.strain[i]);
    result.stress_pa.push_back(curve.stress_pa[i]);
  }
  return result;
}

Curve resampled(const Curve& curve, int points) {
  assert(points >= 2 && !curve.empty());
  Curve result;
  const double first = curve.strain.front(), last = curve.strain.back();
  for (int i = 0; i < points; ++i) {
    const double strain = i + 1 == points ? last : first + (last - first) * i / (points - 1);
    result.strain.push_back(strain);
    result.stress_pa.push_back(stress_at(curve, strain));
  }
  const double area = area_under(result);
  if (area != 0.0) {
    const double ratio = area_under(curve) / area;
    for (double& stress : result.stress_pa) stress *= ratio;
  }
  return result;
}

}  // namespace nacre::tester
