#include "sysid/likelihood.hpp"

#include <algorithm>
#include <cmath>

#include "base/statistics.hpp"
#include "sysid/features.hpp"

namespace nacre::sysid {
namespace {

/// Sums over designs, one residual at a time.
class Residuals {
 public:
  void add(double residual, double variance, double replicate_variance) {
    ++result_.fit.count;
    result_.fit.chi_squared += residual * residual / variance;
    result_.fit.chi_squared_replicates += residual * residual / replicate_variance;
    result_.deviance += residual * residual / variance + std::log(variance);
  }
  Likelihood conclude(int determined) {
    if (result_.fit.count == 0) return result_;
    result_.fit.freedom = std::max(1, result_.fit.count - determined);
    result_.fit.p_value = chi_squared_tail(result_.fit.chi_squared, result_.fit.freedom);
    return result_;
  }

 private:
  Likelihood result_;
};

}  // namespace

double chi_squared_tail(double value, int freedom) {
  const double share = 2.0 / (9.0 * freedom);
  const double z = (std::cbrt(value / freedom) - (1.0 - share)) / std::sqrt(share);
  return normal_cdf(-z);
}

Likelihood modulus_likelihood_of(const std::vector<measurement::Replicates>& measured,
                                 const std::vector<Prediction>& predictions, const NumericsFloor& floor,
                                 int determined) {
  const ReplicateScatter scatter = pooled_scatter(measured);
  const NumericsFloor none = NumericsFloor::none();
  Residuals residuals;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const std::optional<double>& simulated = predictions[i].modulus_pa;
    if (measured[i].modulus_count == 0 || !simulated || *simulated <= 0.0) continue;
    residuals.add(std::log(*simulated / measured[i].modulus_pa), modulus_variance(measured[i], scatter, floor),
                  modulus_variance(measured[i], scatter, none));
  }
  return residuals.conclude(determined);
}

Likelihood toughness_likelihood_of(const std::vector<measurement::Replicates>& measured,
                                   const std::vector<Prediction>& predictions, const NumericsFloor& floor,
                                   int determined) {
  const ReplicateScatter scatter = pooled_scatter(measured);
  const NumericsFloor none = NumericsFloor::none();
  Residuals residuals;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const std::optional<double>& simulated = predictions[i].toughness_pa;
    if (measured[i].toughness_count == 0 || !simulated || *simulated <= 0.0) continue;
    residuals.add(std::log(*simulated / measured[i].toughness_pa), toughness_variance(measured[i], scatter, floor),
                  toughness_variance(measured[i], scatter, none));
  }
  return residuals.conclude(determined);
}

}  // namespace nacre::sysid
