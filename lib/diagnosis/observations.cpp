#include "diagnosis/observations.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace nacre::diagnosis {
namespace {

/// Without replicates a scatter must still be assumed to weigh specimens; every statement is then relative to the fit.
constexpr double kAssumedReplicateSd = 0.02;
/// Replicates that agree better than a testing machine reads say nothing about scatter; exactly equal ones would leave a singular
/// covariance.
constexpr double kLeastReplicateSd = 1e-4;

using GroupKey = std::tuple<std::string, double, double, double>;

GroupKey key_of(const measurement::SpecimenRecord& specimen) {
  const tester::TestConditions& c = specimen.conditions;
  return {specimen.design.name(), c.orientation_deg, c.strain_rate_per_s, c.thickness_mm};
}

/// Means one group; `squares` and `dof` collect the scatter within groups.
Observation mean_of(const std::vector<const measurement::SpecimenRecord*>& replicates, double& squares, int& dof) {
  Observation group;
  group.design = replicates.front()->design;
  group.conditions = replicates.front()->conditions;
  group.batch = replicates.front()->batch;
  group.replicates = static_cast<int>(replicates.size());
  for (const auto* specimen : replicates) {
    group.log_modulus += std::log(*specimen->modulus_pa) / group.replicates;
    group.print_order += static_cast<double>(specimen->print_order) / group.replicates;
    if (specimen->batch != group.batch) group.batch.clear();
  }
  for (const auto* specimen : replicates) squares += std::pow(std::log(*specimen->modulus_pa) - group.log_modulus, 2);
  dof += group.replicates - 1;
  return group;
}

}  // namespace

Eigen::VectorXd Observations::log_moduli() const {
  Eigen::VectorXd y(size());
  for (int i = 0; i < size(); ++i) y[i] = groups[static_cast<std::size_t>(i)].log_modulus;
  return y;
}

Eigen::MatrixXd Observations::covariance(double replicate_variance) const {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size(), size());
  for (int i = 0; i < size(); ++i) {
    const Observation& a = groups[static_cast<std::size_t>(i)];
    matrix(i, i) = replicate_variance / a.replicates;
    for (int j = 0; j < size(); ++j) {
      if (groups[static_cast<std::size_t>(j)].design == a.design) matrix(i, j) += numerics_sd * numerics_sd;
    }
  }
  if (numerics_shared.rows() == size()) matrix += numerics_shared * numerics_shared.transpose();
  return matrix;
}

Eigen::VectorXd Observations::shared_numerics(const Eigen::VectorXd& residuals_at_rows, const std::vector<Eigen::Index>& rows) const {
  if (numerics_shared.rows() != size()) return Eigen::VectorXd::Zero(size());
  const Eigen::MatrixXd all = covariance();
  const Eigen::VectorXd weights = all(rows, rows).llt().solve(residuals_at_rows);
  return numerics_shared * (numerics_shared(rows, Eigen::all).transpose() * weights);
}

Observations observe_moduli(const std::vector<measurement::SpecimenRecord>& specimens, double numerics_sd) {
  // Replicates in the order of their names: the same bits whatever the order of arrival.
  std::map<GroupKey, std::map<std::string, const measurement::SpecimenRecord*>> by_group;
  for (const measurement::SpecimenRecord& specimen : specimens) {
    if (!specimen.valid || !specimen.modulus_pa || specimen.test != tester::TestKind::modulus) continue;
    // A homogeneous coupon shows bulk constants, which voxels do not have (thesis 3.2.4), and no mesh: what the base fit makes of a
    // mesh's softness (6 % between h and h/2) would look like a fault of the coupons.
    if (!specimen.design.layout()) continue;
    by_group[key_of(specimen)].emplace(specimen.specimen, &specimen);
  }
  Observations observations;
  observations.numerics_sd = numerics_sd;
  double squares = 0.0;
  for (const auto& [key, named] : by_group) {
    std::vector<const measurement::SpecimenRecord*> replicates;
    for (const auto& [name, specimen] : named) replicates.push_back(specimen);
    observations.groups.push_back(mean_of(replicates, squares, observations.replicate_dof));
  }
  const double measured_sd = observations.replicate_dof > 0 ? std::sqrt(squares / observations.replicate_dof) : kAssumedReplicateSd;
  observations.replicate_sd = std::max(measured_sd, kLeastReplicateSd);
  return observations;
}

}  // namespace nacre::diagnosis
