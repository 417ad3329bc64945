#include "dashboard/json_parts.hpp"

#include <algorithm>

namespace nacre::dashboard {
namespace {

constexpr int kCurvePoints = 400;

}  // namespace

Json curve_json(const tester::Curve& curve) {
  if (curve.empty()) return nullptr;
  const std::size_t count = curve.size(), most = kCurvePoints, shown = std::min(count, most);
  Json strain = Json::array(), stress = Json::array();
  for (std::size_t i = 0; i < shown; ++i) {
    const std::size_t k = count <= most ? i : i * (count - 1) / (most - 1);
    strain.push_back(curve.strain[k]);
    stress.push_back(curve.stress_pa[k]);
  }
  return {{"strain", strain}, {"stress_pa", stress}};
}

Json errors_json(const sysid::PredictionErrors& e) {
  if (e.modulus_count == 0 && e.toughness_count == 0) return nullptr;
  return {{"modulus_count", e.modulus_count},
          {"modulus_mean", e.modulus_mean},
          {"modulus_max", e.modulus_max},
          {"toughness_count", e.toughness_count},
          {"toughness_mean", e.toughness_mean},
          {"toughness_max", e.toughness_max},
          {"toughness_spearman", e.toughness_spearman}};
}

}  // namespace nacre::dashboard
