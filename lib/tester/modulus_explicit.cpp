#include "tester/modulus_explicit.hpp"

#include <algorithm>
#include <cmath>

#include "fem/explicit_solver.hpp"

namespace nacre::tester {
namespace {

/// Steps over which a specimen must be at rest: 0.1 ms, in which motion that is not overdamped decays by e^-5
/// at gamma = 1e5 /s, so that an oscillation cannot pass for rest.
constexpr int kRestSteps = 1000;
constexpr int kMostSteps = 1'000'000;

Result<fem::ExplicitSolver<double>> stretched_specimen(const fem::Grid& grid, double gamma_per_s) {
  const double wave_limit = fem::longest_step_s(grid, thesis::kDensity);
  return fem::ExplicitSolver<double>::create(grid, {.density_kg_per_m3 = thesis::kDensity,
                                                    .time_step_s = std::min(wave_limit, thesis::kModulusTimeStep.value),
                                                    .strain_rate_per_s = 0.0,
                                                    .initial_strain = thesis::kModulusStrain,
                                                    .damping = fem::Damping::exponential,
                                                    .gamma_per_s = gamma_per_s,
                                                    .simd = {}});
}

/// Stress over strain after `steps` more steps.
Result<double> modulus_after(fem::ExplicitSolver<double>& solver, int steps) {
  double stress_pa = 0.0;
  for (int step = 0; step < steps; ++step) {
    const Result<fem::StepReport> report = solver.step();
    if (!report) return fail("explicit modulus: {}", report.error().message);
    stress_pa = report->stress_pa();
  }
  return stress_pa / thesis::kModulusStrain;
}

}  // namespace

Result<double> explicit_modulus(const fem::Grid& grid, double gamma_per_s, int steps) {
  auto solver = stretched_specimen(grid, gamma_per_s);
  if (!solver) return fail("explicit modulus: {}", solver.error().message);
  return modulus_after(*solver, steps);
}

Result<double> explicit_modulus_at_rest(const fem::Grid& grid, double gamma_per_s, double tolerance) {
  auto solver = stretched_specimen(grid, gamma_per_s);
  if (!solver) return fail("explicit modulus: {}", solver.error().message);
  double last_pa = 0.0;
  while (solver->steps() < kMostSteps) {
    const Result<double> now_pa = modulus_after(*solver, kRestSteps);
    if (!now_pa || std::abs(*now_pa - last_pa) < tolerance * std::abs(*now_pa)) return now_pa;
    last_pa = *now_pa;
  }
  return fail("explicit modulus: not at rest after {} steps with gamma = {} /s", kMostSteps, gamma_per_s);
}

}  // namespace nacre::tester
