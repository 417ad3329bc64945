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
    known_ += variance * variance / (replicate_variance * replicate_variance);
  }
  /// `scatter_freedom`: how well the scatter of replicates is known; an assumed one counts as one degree.
  Likelihood conclude(double freedom_taken, int scatter_freedom) {
    if (result_.fit.count == 0) return result_;
    const double freedom = result_.fit.count - freedom_taken;
    if (freedom < 1.0) return result_;  // the fit meets such data whatever they are
    result_.fit.freedom = static_cast<int>(std::lround(freedom));
    // Satterthwaite: the floor's part of the variances is known, whatever the replicates' is worth.
    const double freedom_below = std::max(1, scatter_freedom) * known_ / result_.fit.count;
    result_.fit.p_value = f_tail(result_.fit.chi_squared / freedom, freedom, freedom_below);
    return result_;
  }

 private:
  Likelihood result_;
  double known_ = 0.0;
};

}  // namespace

double f_tail(double value, double freedom_above, double freedom_below) {
  const double above = 2.0 / (9.0 * freedom_above), below = 2.0 / (9.0 * freedom_below), root = std::cbrt(value);
  return normal_cdf(-((1.0 - below) * root - (1.0 - above)) / std::sqrt(below * root * root + above));
}

Likelihood modulus_likelihood_of(const std::vector<measurement::Replicates>& measured,
                                 const std::vector<Prediction>& predictions, const NumericsFloor& floor,
                                 double freedom_taken) {
  const RelativeScatter scatter = pooled_relative_scatter(measured);
  const NumericsFloor none = NumericsFloor::none();
  Residuals residuals;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const std::optional<double>& simulated = predictions[i].modulus_pa;
    if (measured[i].modulus_count == 0 || !simulated || *simulated <= 0.0) continue;
    residuals.add(std::log(*simulated / measured[i].modulus_pa), modulus_variance(measured[i], scatter, floor),
                  modulus_variance(measured[i], scatter, none));
  }
  return residuals.conclude(freedom_taken, scatter.modulus_freedom);
}

Likelihood toughness_likelihood_of(const std::vector<measurement::Replicates>& measured,
                                   const std::vector<Prediction>& predictions, const NumericsFloor& floor,
                                   double freedom_taken) {
  const RelativeScatter scatter = pooled_relative_scatter(measured);
  const NumericsFloor none = NumericsFloor::none();
  Residuals residuals;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const std::optional<double>& simulated = predictions[i].toughness_pa;
    if (measured[i].toughness_count == 0 || !simulated || *simulated <= 0.0) continue;
    residuals.add(std::log(*simulated / measured[i].toughness_pa), toughness_variance(measured[i], scatter, floor),
                  toughness_variance(measured[i], scatter, none));
  }
  return residuals.conclude(freedom_taken, scatter.toughness_freedom);
}

}  // namespace nacre::sysid
