#include "dashboard/json_parts.hpp"

#include <algorithm>

namespace nacre::dashboard {

std::optional<CurveRow> curve_row(const tester::Curve& curve) {
  constexpr std::size_t kMost = 400;
  if (curve.empty()) return std::nullopt;
  const std::size_t count = curve.size(), shown = std::min(count, kMost);
  CurveRow row;
  for (std::size_t i = 0; i < shown; ++i) {
    const std::size_t k = count <= kMost ? i : i * (count - 1) / (kMost - 1);
    row.strain.push_back(curve.strain[k]);
    row.stress_pa.push_back(curve.stress_pa[k]);
  }
  return row;
}

std::vector<std::array<double, 2>> points_of(const std::vector<optimize::Performance>& performances) {
  std::vector<std::array<double, 2>> points;
  for (const optimize::Performance& each : performances) points.push_back({each.modulus_pa, each.toughness_pa});
  return points;
}

}  // namespace nacre::dashboard
