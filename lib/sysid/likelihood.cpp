#include "sysid/likelihood.hpp"

#include <algorithm>
#include <cmath>

#include "base/statistics.hpp"
#include "sysid/features.hpp"
#include "sysid/shared_errors.hpp"

namespace nacre::sysid {
namespace {

/// Of the designs that have one, one residual at a time.
class Residuals {
 public:
  /// `shared`: change of each design by shared errors of normal size (designs x errors).
  explicit Residuals(Eigen::MatrixXd shared)
      : shared_(std::move(shared)),
        normal_{Eigen::MatrixXd::Identity(shared_.cols(), shared_.cols()), Eigen::VectorXd::Zero(shared_.cols())} {}

  void add(std::size_t design, double residual, double variance, double replicate_variance) {
    ++result_.fit.count;
    result_.fit.chi_squared += residual * residual / variance;
    result_.fit.chi_squared_replicates += residual * residual / replicate_variance;
    result_.deviance += std::log(variance);
    const Eigen::VectorXd moved = shared_.row(static_cast<Eigen::Index>(design)).transpose();
    normal_.information += moved * moved.transpose() / variance;
    normal_.score += moved * residual / variance;
    known_ += variance * variance / (replicate_variance * replicate_variance);
  }
  /// `scatter_freedom`: how well the scatter of replicates is known; an assumed one counts as one degree.
  Likelihood conclude(double freedom_taken, int scatter_freedom) {
    if (result_.fit.count == 0) return result_;
    take_shared_errors_off();
    const double freedom = result_.fit.count - freedom_taken;
    if (freedom < 1.0) return result_;  // the fit meets such data whatever they are
    result_.fit.freedom = static_cast<int>(std::lround(freedom));
    // Satterthwaite: the floor's part of the variances is known, whatever the replicates' is worth.
    const double freedom_below = std::max(1, scatter_freedom) * known_ / result_.fit.count;
    result_.fit.p_value = f_tail(result_.fit.chi_squared / freedom, freedom, freedom_below);
    return result_;
  }

 private:
  /// Of the sizes of the shared errors, given the residuals.
  struct Normal {
    Eigen::MatrixXd information;
    Eigen::VectorXd score;
  };

  /// Woodbury's formula: chi squared and determinant of the whole covariance. Where a fit has absorbed an error,
  /// nothing is left to subtract.
  void take_shared_errors_off() {
    const Eigen::LLT<Eigen::MatrixXd> factor(normal_.information);
    result_.fit.chi_squared -= factor.matrixL().solve(normal_.score).squaredNorm();
    result_.deviance += result_.fit.chi_squared;
    for (Eigen::Index k = 0; k < normal_.score.size(); ++k) result_.deviance += 2.0 * std::log(factor.matrixL()(k, k));
  }

  Likelihood result_;
  Eigen::MatrixXd shared_;
  Normal normal_;
  double known_ = 0.0;
};

}  // namespace

double f_tail(double value, double freedom_above, double freedom_below) {
  const double above = 2.0 / (9.0 * freedom_above), below = 2.0 / (9.0 * freedom_below), root = std::cbrt(value);
  return normal_cdf(-((1.0 - below) * root - (1.0 - above)) / std::sqrt(below * root * root + above));
}

Likelihood modulus_likelihood_of(const std::vector<measurement::Replicates>& measured,
                                 const std::vector<Prediction>& predictions, const DiscretisationFloor& floor,
                                 double freedom_taken) {
  const RelativeScatter scatter = pooled_relative_scatter(measured);
  const DiscretisationFloor none = DiscretisationFloor::none();
  Residuals residuals(shared_modulus_errors(measured, floor));
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const std::optional<double>& simulated = predictions[i].modulus_pa;
    if (measured[i].modulus_count == 0 || !simulated || *simulated <= 0.0) continue;
    residuals.add(i, std::log(*simulated / measured[i].modulus_pa), modulus_variance(measured[i], scatter, floor),
                  modulus_variance(measured[i], scatter, none));
  }
  return residuals.conclude(freedom_taken, scatter.modulus_freedom);
}

Likelihood toughness_likelihood_of(const std::vector<measurement::Replicates>& measured,
                                   const std::vector<Prediction>& predictions, const DiscretisationFloor& floor,
                                   double freedom_taken) {
  const RelativeScatter scatter = pooled_relative_scatter(measured);
  const DiscretisationFloor none = DiscretisationFloor::none();
  Residuals residuals(shared_fracture_errors(measured, floor).topRows(static_cast<Eigen::Index>(measured.size())));
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const std::optional<double>& simulated = predictions[i].toughness_pa;
    if (measured[i].toughness_count == 0 || !simulated || *simulated <= 0.0) continue;
    residuals.add(i, std::log(*simulated / measured[i].toughness_pa), toughness_variance(measured[i], scatter, floor),
                  toughness_variance(measured[i], scatter, none));
  }
  return residuals.conclude(freedom_taken, scatter.toughness_freedom);
}

}  // namespace nacre::sysid
