#include "tester/modulus_explicit.hpp"

#include <algorithm>

#include "fem/explicit_solver.hpp"

namespace nacre::tester {
namespace {

/// Share of the stability limit h / c at which the solver runs.
constexpr double kStabilityShare = 0.8;

}  // namespace

Result<double> explicit_modulus(const fem::Grid& grid, double gamma_per_s, int steps) {
  const double wave_limit = kStabilityShare * grid.element_size_m / fem::fastest_wave_m_per_s(grid, thesis::kDensity);
  auto solver =
      fem::ExplicitSolver<double>::create(grid, {.density_kg_per_m3 = thesis::kDensity,
                                                 .time_step_s = std::min(wave_limit, thesis::kModulusTimeStep.value),
                                                 .strain_rate_per_s = 0.0,
                                                 .initial_strain = thesis::kModulusStrain,
                                                 .damping = fem::Damping::exponential,
                                                 .gamma_per_s = gamma_per_s,
                                                 .simd = {}});
  if (!solver) return fail("explicit modulus: {}", solver.error().message);
  double stress_pa = 0.0;
  for (int step = 0; step < steps; ++step) {
    const Result<fem::StepReport> report = solver->step();
    if (!report) return fail("explicit modulus: {}", report.error().message);
    stress_pa = report->stress_pa();
  }
  return stress_pa / thesis::kModulusStrain;
}

}  // namespace nacre::tester
