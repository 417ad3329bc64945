#include "surrogate/pixel_network.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace nacre::surrogate {
namespace {

constexpr int kSide = pattern::kQuarter;
constexpr int kNodes = kSide * kSide;

/// Two half pixels in series.
double bond(double a, double b) { return 2.0 * a * b / (a + b); }

/// Symmetric positive definite matrix of bandwidth kSide, its lower triangle by columns: entry(i + k, i) = band[i][k].
using Band = std::array<std::array<double, kSide + 1>, kNodes>;

void connect(Band& band, int low, int high, double conductance) {
  band[static_cast<std::size_t>(low)][0] += conductance;
  band[static_cast<std::size_t>(high)][0] += conductance;
  band[static_cast<std::size_t>(low)][static_cast<std::size_t>(high - low)] -= conductance;
}

/// Solves in place by the factorisation L D L'; the band is overwritten.
void solve(Band& band, std::array<double, kNodes>& value) {
  for (int column = 0; column < kNodes; ++column) {
    auto& pivot = band[static_cast<std::size_t>(column)];
    const int reach = std::min(kSide, kNodes - 1 - column);
    for (int k = 1; k <= reach; ++k) {
      const double factor = pivot[static_cast<std::size_t>(k)] / pivot[0];
      auto& other = band[static_cast<std::size_t>(column + k)];
      for (int m = k; m <= reach; ++m)
        other[static_cast<std::size_t>(m - k)] -= factor * pivot[static_cast<std::size_t>(m)];
      value[static_cast<std::size_t>(column + k)] -= factor * value[static_cast<std::size_t>(column)];
    }
  }
  for (int row = kNodes - 1; row >= 0; --row) {
    const auto& pivot = band[static_cast<std::size_t>(row)];
    double sum = value[static_cast<std::size_t>(row)];
    for (int k = 1; k <= std::min(kSide, kNodes - 1 - row); ++k)
      sum -= pivot[static_cast<std::size_t>(k)] * value[static_cast<std::size_t>(row + k)];
    value[static_cast<std::size_t>(row)] = sum / pivot[0];
  }
}

}  // namespace

double log_conductance(const pattern::Pattern& pattern, double soft_conductivity) {
  assert(soft_conductivity > 0.0 && soft_conductivity <= 1.0);
  const auto conductivity = [&](int r, int c) { return pattern.rigid(r, c) ? 1.0 : soft_conductivity; };
  Band band{};
  std::array<double, kNodes> potential{};
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) {
      const int node = r * kSide + c;
      if (c + 1 < kSide) connect(band, node, node + 1, bond(conductivity(r, c), conductivity(r, c + 1)));
      if (r + 1 < kSide) connect(band, node, node + kSide, bond(conductivity(r, c), conductivity(r + 1, c)));
      // Half a pixel to the mirror line: potential 1 above, 0 below.
      const double to_line = 2.0 * conductivity(r, c);
      if (r == 0 || r == kSide - 1) band[static_cast<std::size_t>(node)][0] += to_line;
      if (r == 0) potential[static_cast<std::size_t>(node)] = to_line;
    }
  }
  solve(band, potential);
  double current = 0.0;
  for (int c = 0; c < kSide; ++c) current += 2.0 * conductivity(0, c) * (1.0 - potential[static_cast<std::size_t>(c)]);
  return std::log(current);  // all rigid: ten columns in parallel of ten pixels in series, 1
}

}  // namespace nacre::surrogate
