#include "sysid/shared_errors.hpp"

#include <cmath>

namespace nacre::sysid {
namespace {

constexpr double kTrendUnit = 0.1;  // of rigid fraction: what data/discretisation_floor.toml refers to

/// Rigid fractions less their mean.
Eigen::VectorXd centred_fractions(const std::vector<measurement::Replicates>& measured) {
  Eigen::VectorXd fraction(static_cast<Eigen::Index>(measured.size()));
  for (Eigen::Index i = 0; i < fraction.size(); ++i) fraction[i] = measured[i].design.rigid_fraction();
  if (fraction.size() > 0) fraction.array() -= fraction.mean();
  return fraction;
}

}  // namespace

Eigen::MatrixXd shared_modulus_errors(const std::vector<measurement::Replicates>& measured,
                                      const DiscretisationFloor& floor) {
  Eigen::VectorXd fraction = centred_fractions(measured);
  const Eigen::Index designs = fraction.size();
  const double spread = designs > 0 ? std::sqrt(fraction.squaredNorm() / static_cast<double>(designs)) : 0.0;
  if (spread > 0.0) fraction *= floor.log_modulus_trend_sd / spread;
  return Eigen::VectorXd::Constant(designs, floor.log_modulus_common_sd) - fraction;
}

Eigen::MatrixXd shared_fracture_errors(const std::vector<measurement::Replicates>& measured,
                                       const DiscretisationFloor& floor) {
  const Eigen::VectorXd fraction = centred_fractions(measured) / kTrendUnit;
  const Eigen::Index designs = fraction.size();
  Eigen::MatrixXd shared = Eigen::MatrixXd::Zero(2 * designs, 3);
  shared.col(0).head(designs).setConstant(floor.log_toughness_common_sd);
  shared.col(0).tail(designs).setConstant(floor.log_peak_common_sd);
  shared.col(1).head(designs) = floor.log_toughness_trend_sd * fraction;
  shared.col(2).tail(designs) = floor.log_peak_trend_sd * fraction;
  return shared;
}

}  // namespace nacre::sysid
