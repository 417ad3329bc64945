#include "floor_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nacre::numerics_floor {
namespace {

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<double> result;
  for (const double value : values) {
    const auto below = std::ranges::count_if(values, [&](double other) { return other < value; });
    const auto equal = std::ranges::count(values, value);
    result.push_back(static_cast<double>(below) + 0.5 * static_cast<double>(equal + 1));
  }
  return result;
}

}  // namespace

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double root_mean_square(const std::vector<double>& values, int lost) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / (static_cast<double>(values.size()) - lost));
}

double standard_deviation(const std::vector<double>& values) {
  std::vector<double> centred = values;
  const double middle = mean(values);
  for (double& value : centred) value -= middle;
  return root_mean_square(centred, 1);
}

double spearman(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> x = ranks(a), y = ranks(b);
  const double mean_x = mean(x), mean_y = mean(y);
  double xy = 0.0, xx = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
  }
  return xy / std::sqrt(xx * yy);
}

}  // namespace nacre::numerics_floor
