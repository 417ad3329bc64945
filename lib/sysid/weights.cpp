#include "sysid/weights.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "optimize/pareto.hpp"

namespace nacre::sysid {
namespace {

constexpr double kDensitySpread = 200.0;   // gamma_d of Eq. 2.10
constexpr double kDensityThreshold = 2.0;  // rho_0 of Eq. 2.11

/// A point of the normalised performance space, the unit square.
struct UnitPoint {
  double modulus = 0.0;
  double toughness = 0.0;
};

double squared_distance(UnitPoint a, UnitPoint b) {
  return (a.modulus - b.modulus) * (a.modulus - b.modulus) + (a.toughness - b.toughness) * (a.toughness - b.toughness);
}

double distance_to_segment(UnitPoint p, UnitPoint a, UnitPoint b) {
  const double length = squared_distance(a, b);
  if (length == 0.0) return std::sqrt(squared_distance(p, a));
  const double along =
      ((p.modulus - a.modulus) * (b.modulus - a.modulus) + (p.toughness - a.toughness) * (b.toughness - a.toughness)) /
      length;
  const double t = std::clamp(along, 0.0, 1.0);
  return std::sqrt(
      squared_distance(p, {a.modulus + t * (b.modulus - a.modulus), a.toughness + t * (b.toughness - a.toughness)}));
}

/// The piecewise-linear front, closed by a horizontal line to the toughness axis and a vertical one to the modulus axis
/// (as the polygon hypervolume is), so that a sample next to its ends is as near as one between its corners.
std::vector<UnitPoint> closed_front(std::span<const UnitPoint> points) {
  std::vector<optimize::Performance> performances;
  for (const UnitPoint& point : points) performances.push_back({point.modulus, point.toughness});
  const std::vector<optimize::Performance> front = optimize::pareto_front(performances);
  std::vector<UnitPoint> line = {{0.0, front.front().toughness_pa}};
  for (const optimize::Performance& corner : front) line.push_back({corner.modulus_pa, corner.toughness_pa});
  line.push_back({front.back().modulus_pa, 0.0});
  return line;
}

double distance_to_line(UnitPoint point, std::span<const UnitPoint> line) {
  double nearest = std::sqrt(squared_distance(point, line[0]));
  for (std::size_t i = 1; i < line.size(); ++i) {
    nearest = std::min(nearest, distance_to_segment(point, line[i - 1], line[i]));
  }
  return nearest;
}

/// w1, Eq. 2.9.
double front_weight(double distance) {
  if (distance < 0.2) return 1.0;
  return distance < 0.6 ? 1.4 - 2.0 * distance : 0.2;
}

/// w2, Eqs. 2.10 and 2.11.
double density_weight(UnitPoint point, std::span<const UnitPoint> points) {
  double density = 0.0;
  for (const UnitPoint& other : points) density += std::exp(-kDensitySpread * squared_distance(point, other));
  return std::min(kDensityThreshold / density, 1.0);
}

/// (value - smallest) / (largest - smallest); 1 for all when they are equal.
std::vector<double> normalised(const std::vector<double>& values) {
  const auto [smallest, largest] = std::minmax_element(values.begin(), values.end());
  std::vector<double> result;
  for (const double value : values) {
    result.push_back(*largest > *smallest ? (value - *smallest) / (*largest - *smallest) : 1.0);
  }
  return result;
}

}  // namespace

std::vector<double> sample_weights(const std::vector<measurement::Replicates>& measured) {
  std::vector<double> weights(measured.size(), 1.0);
  std::vector<std::size_t> complete;
  std::vector<double> moduli, toughnesses;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (measured[i].modulus_count == 0 || measured[i].toughness_count == 0) continue;
    complete.push_back(i);
    moduli.push_back(measured[i].modulus_pa);
    toughnesses.push_back(measured[i].toughness_pa);
  }
  if (complete.size() < 2) return weights;
  const std::vector<double> unit_moduli = normalised(moduli), unit_toughnesses = normalised(toughnesses);
  std::vector<UnitPoint> points;
  for (std::size_t k = 0; k < complete.size(); ++k) points.push_back({unit_moduli[k], unit_toughnesses[k]});
  const std::vector<UnitPoint> front = closed_front(points);
  for (std::size_t k = 0; k < complete.size(); ++k) {
    weights[complete[k]] = front_weight(distance_to_line(points[k], front)) * density_weight(points[k], points);
  }
  return weights;
}

}  // namespace nacre::sysid
