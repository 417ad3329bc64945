#include "sysid/features.hpp"

#include <algorithm>
#include <cmath>

#include "base/square.hpp"

namespace nacre::sysid {
namespace {

/// Of a logarithm: no measurement is written with more digits, and replicates that agree exactly have no scatter at
/// all.
constexpr double kSmallestVariance = 1e-12;

/// Of a mean of `count` replicates.
double variance(double scatter, int count, double floor_sd) {
  return std::max(square(scatter) / std::max(1, count) + square(floor_sd), kSmallestVariance);
}

/// Sum of squared relative deviations and degrees of freedom over designs with replicates.
struct Pool {
  double sum = 0.0;
  int freedom = 0;
  void add(int count, double mean, double deviation) {
    if (count < 2 || mean <= 0.0) return;
    sum += (count - 1) * square(deviation / mean);
    freedom += count - 1;
  }
  double deviation(double otherwise) const { return freedom > 0 ? std::sqrt(sum / freedom) : otherwise; }
};

}  // namespace

std::optional<CurveFeatures> features_of(const Prediction& prediction) {
  if (!prediction.toughness_pa || *prediction.toughness_pa <= 0.0) return std::nullopt;
  const double log_toughness = std::log(*prediction.toughness_pa);
  const auto& stress = prediction.curve.stress_pa;
  const double peak = stress.empty() ? 0.0 : *std::max_element(stress.begin(), stress.end());
  return CurveFeatures{log_toughness, peak > 0.0 ? std::log(peak) : 0.5 * log_toughness};
}

std::optional<double> peak_of(const measurement::Replicates& measured) {
  const auto& stress = measured.representative_curve.stress_pa;
  if (measured.toughness_count == 0 || stress.empty()) return std::nullopt;
  const double peak = *std::max_element(stress.begin(), stress.end());
  return peak > 0.0 ? std::optional(peak) : std::nullopt;
}

RelativeScatter pooled_relative_scatter(const std::vector<measurement::Replicates>& measured,
                                        const RelativeScatter& otherwise) {
  Pool modulus, toughness;
  for (const measurement::Replicates& design : measured) {
    modulus.add(design.modulus_count, design.modulus_pa, design.modulus_sd_pa);
    toughness.add(design.toughness_count, design.toughness_pa, design.toughness_sd_pa);
  }
  return {modulus.deviation(otherwise.log_modulus), toughness.deviation(otherwise.log_toughness), modulus.freedom,
          toughness.freedom};
}

double modulus_variance(const measurement::Replicates& measured, const RelativeScatter& scatter,
                        const DiscretisationFloor& floor) {
  return variance(scatter.log_modulus, measured.modulus_count, floor.log_modulus_sd);
}

double toughness_variance(const measurement::Replicates& measured, const RelativeScatter& scatter,
                          const DiscretisationFloor& floor) {
  return variance(scatter.log_toughness, measured.toughness_count, floor.log_toughness_sd);
}

double peak_variance(const RelativeScatter& scatter, const DiscretisationFloor& floor) {
  return variance(scatter.log_toughness, 1, floor.log_peak_sd);
}

}  // namespace nacre::sysid
