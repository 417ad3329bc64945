#include "sysid/errors.hpp"

#include <algorithm>
#include <cmath>

#include "base/statistics.hpp"

namespace nacre::sysid {
namespace {

/// Count, mean and largest of |simulated - measured| / measured.
struct ErrorSum {
  int count = 0;
  double sum = 0.0, largest = 0.0;
  void add(double simulated, double measured) {
    const double error = std::abs(simulated - measured) / measured;
    ++count;
    sum += error;
    largest = std::max(largest, error);
  }
  double mean() const { return count == 0 ? 0.0 : sum / count; }
};

}  // namespace

PredictionErrors prediction_errors(const std::vector<measurement::Replicates>& measured,
                                   const std::vector<Prediction>& predictions) {
  ErrorSum modulus, toughness;
  std::vector<double> simulated_pa, measured_pa;
  for (std::size_t i = 0; i < measured.size() && i < predictions.size(); ++i) {
    if (measured[i].modulus_count > 0 && predictions[i].modulus_pa) {
      modulus.add(*predictions[i].modulus_pa, measured[i].modulus_pa);
    }
    if (measured[i].toughness_count > 0 && predictions[i].toughness_pa) {
      toughness.add(*predictions[i].toughness_pa, measured[i].toughness_pa);
      simulated_pa.push_back(*predictions[i].toughness_pa);
      measured_pa.push_back(measured[i].toughness_pa);
    }
  }
  return {.modulus_count = modulus.count,
          .modulus_mean = modulus.mean(),
          .modulus_max = modulus.largest,
          .toughness_count = toughness.count,
          .toughness_mean = toughness.mean(),
          .toughness_max = toughness.largest,
          .toughness_spearman = rank_correlation(simulated_pa, measured_pa)};
}

}  // namespace nacre::sysid
