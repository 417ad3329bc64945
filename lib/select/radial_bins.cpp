#include "select/radial_bins.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "thesis/constants.hpp"

namespace nacre::select {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2.0;
constexpr double kThresholdAngle = thesis::kBinAngleThreshold / 180.0 * std::numbers::pi;

}  // namespace

std::vector<double> elevation_angles(std::span<const explore::Evaluated> candidates) {
  if (candidates.empty()) return {};
  const auto less_stiff = [](const explore::Evaluated& a, const explore::Evaluated& b) {
    return a.performance.modulus_pa < b.performance.modulus_pa;
  };
  const auto less_tough = [](const explore::Evaluated& a, const explore::Evaluated& b) {
    return a.performance.toughness_pa < b.performance.toughness_pa;
  };
  const auto [softest, stiffest] = std::minmax_element(candidates.begin(), candidates.end(), less_stiff);
  const auto [weakest, toughest] = std::minmax_element(candidates.begin(), candidates.end(), less_tough);
  const double highest_modulus = stiffest->performance.modulus_pa;
  const double zero_modulus =
      std::min(toughest->performance.modulus_pa, (softest->performance.modulus_pa + highest_modulus) / 2.0);
  const double lowest_toughness = weakest->performance.toughness_pa;
  const double toughness_range = toughest->performance.toughness_pa - lowest_toughness;

  std::vector<double> angles;
  angles.reserve(candidates.size());
  for (const explore::Evaluated& candidate : candidates) {
    const double modulus_range = highest_modulus - zero_modulus;
    const double x = modulus_range > 0.0 ? (candidate.performance.modulus_pa - zero_modulus) / modulus_range : 0.0;
    const double y =
        toughness_range > 0.0 ? (candidate.performance.toughness_pa - lowest_toughness) / toughness_range : 1.0;
    angles.push_back(x == 0.0 && y == 0.0 ? kRightAngle : std::atan2(y, x));
  }
  return angles;
}

int second_quadrant_bins(double largest_angle, int count) {
  if (largest_angle < kRightAngle + kThresholdAngle) return 0;
  const int bins = static_cast<int>(std::ceil((1.0 - std::numbers::pi / (2.0 * largest_angle)) * count));
  return std::min(bins, count - 1);
}

int radial_bin(double angle, double largest_angle, int count) {
  const int left = second_quadrant_bins(largest_angle, count), right = count - left;
  if (angle > kRightAngle) {
    if (left == 0) return 0;
    const double share = (largest_angle - angle) / (largest_angle - kRightAngle);
    return std::clamp(static_cast<int>(share * left), 0, left - 1);
  }
  const double share = (kRightAngle - angle) / kRightAngle;
  return left + std::clamp(static_cast<int>(share * right), 0, right - 1);
}

std::vector<int> radial_bins(std::span<const explore::Evaluated> candidates, int count) {
  const std::vector<double> angles = elevation_angles(candidates);
  if (angles.empty()) return {};
  const double largest_angle = *std::max_element(angles.begin(), angles.end());
  std::vector<int> bins;
  bins.reserve(angles.size());
  for (const double angle : angles) bins.push_back(radial_bin(angle, largest_angle, count));
  return bins;
}

}  // namespace nacre::select
