#include "modulus_floor.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "base/statistics.hpp"
#include "base_refit.hpp"

namespace nacre::discretisation_floor {
namespace {

std::vector<double> log_moduli(const FloorPlan& plan, const material::ModulusParameters& theta, int refinement,
                               int threads) {
  std::vector<double> logs(plan.layouts.size());
  parallel_for(
      static_cast<int>(logs.size()),
      [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        logs[at] = std::log(modulus_pa(plan, plan.layouts[at], theta, refinement));
      },
      threads);
  return logs;
}

std::vector<double> minus(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result;
  for (std::size_t i = 0; i < a.size(); ++i) result.push_back(a[i] - b[i]);
  return result;
}

std::vector<double> centred(std::vector<double> values) {
  const double middle = mean(values);
  for (double& value : values) value -= middle;
  return values;
}

/// Limit of log E at vanishing elements less that at h, by Aitken's extrapolation of h, h/2, h/4; the common ratio of
/// the two changes is taken over all layouts, since it is the order of convergence.
std::vector<double> extrapolated(const std::vector<double>& first, const std::vector<double>& second, double ratio) {
  std::vector<double> changes;
  for (std::size_t i = 0; i < first.size(); ++i) changes.push_back(first[i] + second[i] / (1.0 - ratio));
  return changes;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

void append(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

ModulusFloor modulus_floor(const FloorPlan& plan, int threads) {
  ModulusFloor floor;
  std::vector<double> changes, rescaled, residuals, residuals_of[2], first_changes, second_changes;
  int free_parameters = 0;
  for (const material::ParameterSet& set : plan.sets) {
    const std::vector<double> coarse = log_moduli(plan, set.modulus, 1, threads),
                              half = log_moduli(plan, set.modulus, 2, threads),
                              quarter = log_moduli(plan, set.modulus, 4, threads);
    const std::vector<double> change = minus(half, coarse);
    append(changes, change);
    append(rescaled, centred(change));
    append(first_changes, change);
    append(second_changes, minus(quarter, half));
    const ModulusRefit refit = refit_moduli(half, set.modulus, [&](const material::ModulusParameters& theta) {
      return log_moduli(plan, theta, 1, threads);
    });
    free_parameters += refit.free_parameters;
    append(residuals, refit.residual);
    floor.residuals.push_back(refit.residual);
    for (std::size_t i = 0; i < plan.layouts.size(); ++i)
      residuals_of[plan.layouts[i].rigid_fraction() >= kManyRigid ? 1 : 0].push_back(refit.residual[i]);
  }
  floor.mean = mean(changes);
  floor.sd_rescaled = root_mean_square(rescaled, static_cast<int>(plan.sets.size()));
  floor.sd = root_mean_square(residuals, free_parameters);
  for (std::size_t k = 0; k < 2; ++k)
    floor.at_sd[k] = residuals_of[k].empty() ? 0.0 : root_mean_square(residuals_of[k]);
  const double ratio = dot(first_changes, second_changes) / dot(first_changes, first_changes);
  floor.observed_order = -std::log2(ratio);
  floor.mesh_amplitude = 1.0 / (1.0 - ratio);
  std::vector<double> remainder = extrapolated(first_changes, second_changes, ratio);
  for (std::size_t i = 0; i < remainder.size(); ++i) remainder[i] -= floor.mesh_amplitude * first_changes[i];
  floor.mesh_remainder_sd = root_mean_square(remainder, 1);
  return floor;
}

std::string to_toml(const ModulusFloor& floor, const FloorPlan& plan) {
  return fmt::format(
      "modulus_layouts = {}\nmodulus_parameter_sets = {}\n"
      "log_modulus_mean = {:.4f}  # log E(h/2) - log E(h)\n"
      "log_modulus_sd_rescaled = {:.5f}  # after one common factor\n"
      "log_modulus_sd = {:.5f}  # after a refit of 6 constants; below 75 % rigid {:.5f}, from there {:.5f}\n"
      "# Covariance of log E(0) - log E(h) between layouts i and j: amplitude^2 c_i c_j + (i = j) remainder_sd^2, "
      "where c is\n"
      "# log E(h/2) - log E(h) of the layout itself, which a diagnosis computes. Observed order of convergence "
      "{:.2f}.\n"
      "mesh_amplitude = {:.3f}\nmesh_remainder_sd = {:.5f}\n",
      plan.layouts.size(), plan.sets.size(), floor.mean, floor.sd_rescaled, floor.sd, floor.at_sd[0], floor.at_sd[1],
      floor.observed_order, floor.mesh_amplitude, floor.mesh_remainder_sd);
}

}  // namespace nacre::discretisation_floor
