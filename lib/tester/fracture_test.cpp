#include "tester/fracture_test.hpp"

#include <algorithm>
#include <cmath>

#include "fem/static_solver.hpp"
#include "material/extensions.hpp"
#include "tester/assembly.hpp"
#include "tester/fidelity.hpp"
#include "tester/film_strains.hpp"
#include "tester/fracture_watch.hpp"
#include "tester/notch.hpp"
#include "tester/refinement.hpp"
#include "tester/strength_field.hpp"
#include "tester/strength_scatter.hpp"
#include "thesis/constants.hpp"

namespace nacre::tester {
namespace {

/// Largest alpha = gamma dt of the filter (2.4). It multiplies the velocity of the shortest waves by 1 - 4 alpha / 3 in
/// every step; where that is negative (alpha > 3/4), symplectic Euler amplifies them without bound, however small the
/// step is for the waves. At 1/2 T is within 15 % of its limit for the strongest damping allowed, and within 2 % for
/// common ones.
constexpr double kLargestAlpha = 0.5;
/// Largest number of repetitions, each with half the step, of a specimen that blew up.
constexpr int kMostHalvings = 2;
/// Strain between samples of the curve.
constexpr double kSampleStrain = 1e-4;

/// The thesis' 2e-7 s, or less where waves or the filter demand it. Pure soft material, which is pulled much further,
/// and the smaller fidelities take what both allow: it changes their T by about 1 % and halves their time.
double time_step_s(const fem::Grid& grid, double gamma_per_s, bool capped) {
  const double wave_limit = fem::longest_step_s(grid, thesis::kDensity);
  const double limit = std::min(wave_limit, kLargestAlpha / gamma_per_s);
  return capped ? std::min(limit, thesis::kTimeStep.value) : limit;
}

template <class Real>
FractureFrame frame_of(const fem::ExplicitSolver<Real>& solver, const fem::Grid& grid, double grip_strain) {
  FractureFrame frame{.strain = grip_strain,
                      .columns = grid.columns,
                      .rows = grid.rows,
                      .element_size_m = grid.element_size_m,
                      .material = {},
                      .energy_j_per_m3 = {},
                      .displacement_m = {}};
  for (int element = 0; element < grid.element_count(); ++element) {
    const fem::Phase phase = solver.is_empty(element) ? fem::Phase::empty : grid.phase[element];
    frame.material.push_back(static_cast<std::uint8_t>(phase));
    frame.energy_j_per_m3.push_back(static_cast<float>(solver.energy_density_j_per_m3(element)));
  }
  for (int node = 0; node < (grid.columns + 1) * (grid.rows + 1); ++node) {
    const Eigen::Vector2d displacement_m = solver.displacement_m(node);
    frame.displacement_m.push_back(static_cast<float>(displacement_m.x()));
    frame.displacement_m.push_back(static_cast<float>(displacement_m.y()));
  }
  return frame;
}

/// One pull; keeps a frame at the first step that reaches each of the given strains.
template <class Real>
Result<ToughnessResult> pull(const FractureTest& test, const std::vector<double>& frame_strains) {
  Result<MountedSpecimen<Real>> specimen = mount<Real>(test);
  if (!specimen) return fail("toughness tester: {}", specimen.error().message);
  fem::ExplicitSolver<Real>* const solver = &specimen->solver;
  FractureWatch watch(test);
  std::vector<FractureFrame> frames;
  for (bool over = false; !over;) {
    while (frames.size() < frame_strains.size() &&
           specimen->grip_strain(solver->strain()) >= frame_strains[frames.size()])
      frames.push_back(frame_of(*solver, test.grid, specimen->grip_strain(solver->strain())));
    const Result<fem::StepReport> report = solver->step();
    if (!report) return fail("toughness tester: {}", report.error().message);
    over = watch.add(specimen->grip_strain(report->strain), report->stress_pa(), solver->steps());
    if (report->failed > 0) watch.add_breaks(solver->last_failed());
  }
  // A solution that just blew up may look like one that broke.
  if (const Result<void> sound = solver->check(); !sound) return fail("toughness tester: {}", sound.error().message);
  Result<ToughnessResult> result = watch.take();
  if (result) result->frames = std::move(frames);
  return result;
}

double strain_within_steps(const FractureTest& test) {
  return test.settings.strain_rate_per_s * test.settings.time_step_s * static_cast<double>(thesis::kStepLimit);
}

/// The name from which one specimen's voxels are drawn.
std::string specimen_name(const Simulation& simulation) {
  return fmt::format("{} at {} degrees, {}, specimen {}", simulation.design.name(),
                     simulation.conditions.orientation_deg, to_string(simulation.fidelity), simulation.specimen);
}

}  // namespace

FractureTest fracture_test(const Simulation& simulation, const Discretisation& discretisation) {
  const SpecimenUnits units = toughness_units(simulation.fidelity);
  const int own_refinement = refinement_of(simulation.fidelity),
            refinement = own_refinement * discretisation.refinement;
  FractureTest test;
  test.grid = assemble(simulation.design, simulation.parameters, simulation.conditions, AssemblyTarget::toughness,
                       units.x, units.y, refinement);
  set_criterion(test.grid, refinement, simulation.parameters.criterion);
  draw_strengths(test.grid, refinement, simulation);
  const material::Extensions& extensions = simulation.parameters.extensions;
  scatter_strength(test.grid, refinement, material::extension_value(extensions, "strength_scatter"),
                   specimen_name(simulation));
  cut_notch(test.grid, refinement);
  round_notch_root(test.grid, refinement, material::extension_value(extensions, "blunt_notch"));
  const bool pure_soft = simulation.design.rigid_fraction() == 0.0;
  const double gamma_per_s = refined(simulation.parameters, own_refinement).toughness.gamma_per_s;
  const bool capped = simulation.fidelity == Fidelity::full && !pure_soft;
  test.settings = {.density_kg_per_m3 = thesis::kDensity,
                   .time_step_s = time_step_s(test.grid, gamma_per_s, capped) * discretisation.time_step_scale,
                   .strain_rate_per_s = thesis::kSimulatedStrainRate * loading_rate_scale(simulation.fidelity) *
                                        discretisation.rate_scale,
                   .damping = fem::Damping::smoothing,
                   .gamma_per_s = gamma_per_s,
                   .simd = {}};
  // The machine pulls slowly, the solver fast: what relaxes does so at the same strain (docs/METHODS.md).
  test.grid.laws.relaxation_time_s *= simulation.conditions.strain_rate_per_s / test.settings.strain_rate_per_s;
  test.strain_limit = pure_soft ? thesis::kSoftStrainLimit : thesis::kStrainLimit;
  test.limit_is_no_failure = pure_soft;
  const double sample_strain =
      kSampleStrain * test.strain_limit / thesis::kStrainLimit / discretisation.recording_scale;
  const double strain_per_step = test.settings.strain_rate_per_s * test.settings.time_step_s;
  test.steps_per_sample = static_cast<int>(
      std::clamp(std::round(sample_strain / strain_per_step), 1.0, static_cast<double>(thesis::kStepLimit)));
  test.frame_count = discretisation.frame_count;
  return test;
}

template <class Real>
Result<MountedSpecimen<Real>> mount(const FractureTest& test) {
  fem::ExplicitSettings settings = test.settings;
  Result<fem::RestingSolution> rest = fem::RestingSolution{};
  if (!test.grid.laws.eigenstrain.empty()) {
    rest = fem::pull_from_rest(test.grid, 0.0);
    if (!rest) return tl::unexpected(rest.error());
    settings.initial_strain = rest->rest_strain;
  }
  Result<fem::ExplicitSolver<Real>> solver = fem::ExplicitSolver<Real>::create(test.grid, settings);
  if (!solver) return tl::unexpected(solver.error());
  for (std::size_t node = 0; 2 * node < rest->displacement.size(); ++node) {
    const Eigen::Vector2d displacement(rest->displacement[2 * node], rest->displacement[2 * node + 1]);
    const int at = node;
    solver->set_node(at, displacement * test.grid.element_size_m, solver->velocity_m_per_s(at));
  }
  if (!rest->displacement.empty()) solver->relax();
  return MountedSpecimen<Real>{*std::move(solver), rest->rest_strain};
}

template <class Real>
Result<ToughnessResult> run_fracture_test(const FractureTest& given) {
  FractureTest test = given;
  Result<ToughnessResult> result = pull<Real>(test, test.frame_strains);
  // Pure soft material is pulled, and elements that soften are squeezed, so far that waves outrun a step that was long
  // enough at rest.
  const bool may_stiffen = test.limit_is_no_failure || test.grid.laws.softening > 0.0;
  for (int halvings = 0; !result && may_stiffen && halvings < kMostHalvings; ++halvings) {
    test.settings.time_step_s *= 0.5;
    test.steps_per_sample *= 2;
    if (strain_within_steps(test) < test.strain_limit) break;  // the limit is out of reach
    result = pull<Real>(test, test.frame_strains);
  }
  if (!result || test.frame_count == 0) return result;
  // The strains of the events are known once the specimen has broken, so it is pulled again.
  return pull<Real>(test, film_strains(*result, test.frame_count));
}

template Result<MountedSpecimen<float>> mount<float>(const FractureTest&);
template Result<MountedSpecimen<double>> mount<double>(const FractureTest&);
template Result<ToughnessResult> run_fracture_test<float>(const FractureTest&);
template Result<ToughnessResult> run_fracture_test<double>(const FractureTest&);

}  // namespace nacre::tester
