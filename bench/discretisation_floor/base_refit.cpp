#include "base_refit.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace nacre::discretisation_floor {
namespace {

constexpr int kConstants = 6;  // all but gamma, which a static test does not use
constexpr int kIterations = 8;

/// Parameters with constant `i` changed by `step`: E multiplied by e^step, step added to nu.
material::ModulusParameters stepped(const material::ModulusParameters& parameters, int i, double step) {
  material::ModulusVector vector = material::to_vector(parameters);
  double& value = vector[i];
  value = i < 3 ? value * std::exp(step) : std::clamp(value + step, 0.01, 0.499);
  return material::modulus_from_vector(vector);
}

double sum_of_squares(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum;
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] - b[i];
  return result;
}

}  // namespace

std::vector<std::vector<double>> sensitivities(const material::ModulusParameters& parameters, const LogModuli& predict,
                                               const std::vector<double>& at_parameters) {
  std::vector<std::vector<double>> columns;
  for (int i = 0; i < kConstants; ++i) {
    const double step = i < 3 ? 1e-3 : -1e-3;
    std::vector<double> column = difference(predict(stepped(parameters, i, step)), at_parameters);
    for (double& value : column) value /= step;
    columns.push_back(std::move(column));
  }
  return columns;
}

ModulusRefit refit_moduli(const std::vector<double>& target_log_e, const material::ModulusParameters& start,
                          const LogModuli& predict) {
  ModulusRefit refit{
      .parameters = start, .residual = difference(target_log_e, predict(start)), .free_parameters = kConstants};
  const auto rows = static_cast<Eigen::Index>(target_log_e.size());
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const auto columns = sensitivities(refit.parameters, predict, difference(target_log_e, refit.residual));
    Eigen::MatrixXd jacobian(rows, kConstants);
    for (int i = 0; i < kConstants; ++i) {
      jacobian.col(i) = Eigen::Map<const Eigen::VectorXd>(columns[i].data(), rows);
    }
    const Eigen::Map<const Eigen::VectorXd> residual(refit.residual.data(), rows);
    const Eigen::VectorXd step = jacobian.colPivHouseholderQr().solve(residual);
    const double before = sum_of_squares(refit.residual);
    bool improved = false;
    for (double share = 1.0; share > 0.05 && !improved; share /= 2.0) {
      material::ModulusParameters candidate = refit.parameters;
      for (int i = 0; i < kConstants; ++i) candidate = stepped(candidate, i, share * step(i));
      std::vector<double> left = difference(target_log_e, predict(candidate));
      if (sum_of_squares(left) >= before * (1.0 - 1e-6)) continue;
      refit.parameters = candidate;
      refit.residual = std::move(left);
      improved = true;
    }
    if (!improved) break;
  }
  return refit;
}

}  // namespace nacre::discretisation_floor
