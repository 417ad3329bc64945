#include "fem/explicit_solver.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "material/extended_law.hpp"

namespace nacre::fem {
namespace {

constexpr int kCheckInterval = 16;

/// Largest alpha = gamma dt of Eq. 2.4. The filter multiplies a wave, after its acceleration was added, by
/// f = 1 - alpha (1 - m), where m >= -1/3 is its mean over nine nodes relative to itself. With s = (omega dt)^2
/// symplectic Euler then has p(z) = z^2 - (1 + f - f s) z + f, and p(1) = f s: for f < 0 one root lies beyond 1 for
/// every s > 0. From alpha = 3/4 on waves with m = -1/3 grow without bound, however small the step.
constexpr double kLargestSmoothing = 0.75;

/// Lame parameters of an element of the grid.
material::Lame lame_of(const Grid& grid, int element) {
  return material::lame_from_engineering(grid.young_pa[element], grid.poisson[element]);
}

/// lambda + 2 mu, or of the stiffest state that the laws of the grid allow.
double stiffest_pa(const Grid& grid, int element) {
  const material::Lame lame = lame_of(grid, element);
  const GridLaws& laws = grid.laws;
  if (!laws.any()) return lame.lambda_pa + 2.0 * lame.mu_pa;
  material::ExtendedLaw law{.lame = lame};
  law.overstress = laws.overstress;
  if (!laws.inverse_limit.empty()) law.inverse_limit = laws.inverse_limit[element];
  const double last = 1.0 + laws.softening;
  return material::stiffest_tangent_pa(law, grid.threshold_j_per_m3[element] * last * last);
}

/// dN/dX of the four corners (bottom-left, bottom-right, top-left, top-right) at Gauss point `point`, on the unit
/// square.
Eigen::Matrix<double, 4, 2> shape_gradients(int point) {
  const double low = 0.5 * (1.0 - 1.0 / std::sqrt(3.0));
  const double x = point % 2 == 0 ? low : 1.0 - low, y = point / 2 == 0 ? low : 1.0 - low;
  Eigen::Matrix<double, 4, 2> gradients;
  gradients << -(1.0 - y), -(1.0 - x), 1.0 - y, -x, -y, 1.0 - x, y, x;
  return gradients;
}

}  // namespace

double fastest_wave_m_per_s(const Grid& grid, double density_kg_per_m3) {
  double stiffest = 0.0;
  for (int element = 0; element < grid.element_count(); ++element) {
    if (grid.phase[element] == Phase::empty) continue;
    stiffest = std::max(stiffest, stiffest_pa(grid, element));
  }
  return std::sqrt(stiffest / density_kg_per_m3);
}

double longest_step_s(const Grid& grid, double density_kg_per_m3) {
  constexpr double kStabilityShare = 0.8;
  return kStabilityShare * grid.element_size_m / fastest_wave_m_per_s(grid, density_kg_per_m3);
}

template <class Real>
ExplicitSolver<Real>::ExplicitSolver(const Grid& grid, const ExplicitSettings& settings)
    : grid_(grid),
      settings_(settings),
      storage_(grid.columns, grid.rows, settings.keep_ledger, grid.neighbourhood_m > 0.0) {
  const SimdLevel level = settings.simd.value_or(best_simd_level());
  assert(has_simd_level(level));
  kernel_ = &explicit_kernel<Real>(level);
  static_cast<ExplicitState<Real>&>(state_) = storage_.state();
  const double alpha = settings.gamma_per_s * settings.time_step_s;
  std::fill_n(state_.row.weight + 1, grid.columns - 1, static_cast<Real>(alpha));
  state_.damping = settings.damping;
  state_.decay = static_cast<Real>(std::exp(-alpha));
  state_.grip_step = settings.strain_rate_per_s * settings.time_step_s * grid.rows;
  fill_elements();
  if (grid.laws.any()) {
    extended_ = std::make_unique<ExtendedStorage<Real>>(grid, element_scale(), settings.time_step_s, state_);
    extended_kernel_ = &extended_kernel<Real>(level);
  }
  if (grid.neighbourhood_m > 0.0) neighbourhood_.emplace(grid.neighbourhood_m / grid.element_size_m, state_);
  if (settings.keep_ledger) {
    ledger_.initial_kinetic = kinetic_energy();
    ledger_.initial_stored = stored_energy();
  }
}

template <class Real>
ExplicitSolver<Real>::ExplicitSolver(ExplicitSolver&&) noexcept = default;
template <class Real>
ExplicitSolver<Real>::~ExplicitSolver() = default;

template <class Real>
Result<ExplicitSolver<Real>> ExplicitSolver<Real>::create(const Grid& grid, const ExplicitSettings& settings) {
  assert(grid.columns >= 2 && grid.rows >= 2 && static_cast<int>(grid.phase.size()) == grid.element_count());
  const double dt = settings.time_step_s, wave = fastest_wave_m_per_s(grid, settings.density_kg_per_m3);
  if (!(dt > 0.0) || !std::isfinite(wave) || !(settings.gamma_per_s >= 0.0))
    return fail("time step {} s, wave speed {} m/s and gamma {} /s must be finite and not negative", dt, wave,
                settings.gamma_per_s);
  if (dt * wave > settings.largest_courant_number * grid.element_size_m)
    return fail("time step {} s is beyond the stability limit {} s", dt, grid.element_size_m / wave);
  if (settings.damping == Damping::smoothing && dt * settings.gamma_per_s > kLargestSmoothing)
    return fail(
        "alpha = gamma dt = {} is beyond {}, up to which the filter of Eq. 2.4 is stable: time step at most {} s",
        dt * settings.gamma_per_s, kLargestSmoothing, kLargestSmoothing / settings.gamma_per_s);
  if (settings.keep_ledger && (grid.laws.any() || grid.neighbourhood_m > 0.0))
    return fail("no ledger of energies is kept with an extended law or the neighbourhood criterion");
  return ExplicitSolver(grid, settings);
}

template <class Real>
double ExplicitSolver<Real>::element_scale() const {
  const double h = grid_.element_size_m, dt = settings_.time_step_s;
  return dt * dt / (4.0 * settings_.density_kg_per_m3 * h * h);
}

template <class Real>
void ExplicitSolver<Real>::fill_elements() {
  const double scale = element_scale();
  // A softening element fails when s = sqrt(w / W) reaches this; the neighbourhood sets it when the tail begins.
  const double last = grid_.neighbourhood_m > 0.0 ? 1.0 : 1.0 + grid_.laws.softening;
  std::fill_n(state_.threshold, static_cast<std::size_t>(grid_.rows) * state_.element_stride,
              std::numeric_limits<Real>::infinity());
  for (int row = 0; row < grid_.rows; ++row) {
    for (int column = 0; column < grid_.columns; ++column) {
      const int element = grid_.index(row, column), at = row * state_.element_stride + column;
      if (grid_.phase[element] == Phase::empty) continue;
      const material::Lame lame = lame_of(grid_, element);
      state_.mu[at] = static_cast<Real>(lame.mu_pa * scale);
      state_.lambda[at] = static_cast<Real>(lame.lambda_pa * scale);
      state_.threshold[at] = static_cast<Real>(2.0 * last * last * grid_.threshold_j_per_m3[element] * scale);
    }
  }
}

template <class Real>
double ExplicitSolver<Real>::stress_unit_pa() const {
  const double h = grid_.element_size_m, dt = settings_.time_step_s;
  return settings_.density_kg_per_m3 * h * h / (dt * dt) / grid_.columns;
}

/// One step of the kernel that the grid needs.
template <class Real>
void ExplicitSolver<Real>::advance() {
  const bool only_softens = extended_ && !grid_.laws.any_beside_softening() && !neighbourhood_;
  if (only_softens && grid_.laws.is_crack_band) {
    extended_kernel_->advance_crack_band(state_);
  } else if (extended_) {
    extended_kernel_->advance(state_);
  } else if (neighbourhood_) {
    kernel_->advance_with_energies(state_);
  } else if (settings_.keep_ledger) {
    kernel_->advance_with_ledger(state_);
  } else {
    kernel_->advance(state_);
  }
  if (neighbourhood_) neighbourhood_->keep_failing(state_);
}

template <class Real>
Result<StepReport> ExplicitSolver<Real>::step() {
  state_.strain = static_cast<Real>(strain());
  advance();
  const double h = grid_.element_size_m, dt = settings_.time_step_s;
  const StepReport report{.strain = strain(),
                          .top_stress_pa = state_.top_force * stress_unit_pa(),
                          .bottom_stress_pa = state_.bottom_force * stress_unit_pa(),
                          .failed = state_.failed_count};
  if (settings_.keep_ledger) {
    const double width = grid_.columns * h, height = grid_.rows * h;
    ledger_.work += report.top_stress_pa * width * settings_.strain_rate_per_s * height * dt;
    ledger_.damped += 0.5 * settings_.density_kg_per_m3 * std::pow(h, 4) / (dt * dt) * state_.damping_work;
  }
  ++steps_;
  for (int i = 0; i < state_.failed_count; ++i)
    if (!(smallest_volume_ratio(state_.failed[i]) > 0.0)) return blow_up(state_.failed[i]);
  erase_failed();
  if (steps_ % kCheckInterval == 0)
    if (const Result<void> sound = check(); !sound) return tl::unexpected(sound.error());
  return report;
}

template <class Real>
Result<void> ExplicitSolver<Real>::check() const {
  const int inverted = kernel_->first_inverted(state_);
  if (inverted >= 0) return blow_up(inverted);
  return {};
}

template <class Real>
void ExplicitSolver<Real>::erase_failed() {
  for (int i = 0; i < state_.failed_count; ++i) {
    const int element = state_.failed[i];
    const int at = element / grid_.columns * state_.element_stride + element % grid_.columns;
    // Its last forces acted over the step centred on the state found: half of the step that followed belongs to it.
    if (settings_.keep_ledger) ledger_.fractured += element_energy(element, 0.5);
    state_.mu[at] = state_.lambda[at] = Real{0};
    state_.threshold[at] = std::numeric_limits<Real>::infinity();
    if (extended_) erase_laws(state_, at);
    grid_.phase[element] = Phase::empty;
  }
}

template <class Real>
tl::unexpected<Error> ExplicitSolver<Real>::blow_up(int element) const {
  return fail("the solution blew up: J = {:.3g} in element row {} column {} at step {}, strain {:.4g}",
              smallest_volume_ratio(element), element / grid_.columns, element % grid_.columns, steps_, strain());
}

template <class Real>
double ExplicitSolver<Real>::strain() const {
  return settings_.initial_strain + settings_.strain_rate_per_s * settings_.time_step_s * static_cast<double>(steps_);
}

template <class Real>
std::vector<int> ExplicitSolver<Real>::last_failed() const {
  return {state_.failed, state_.failed + state_.failed_count};
}

template <class Real>
bool ExplicitSolver<Real>::is_empty(int element) const {
  return grid_.phase[element] == Phase::empty;
}

template <class Real>
std::size_t ExplicitSolver<Real>::node_offset(int node) const {
  const int per_row = grid_.columns + 1;
  return static_cast<std::size_t>(node / per_row) * state_.stride + node % per_row;
}

template <class Real>
Eigen::Vector2d ExplicitSolver<Real>::displacement_m(int node) const {
  const std::size_t at = node_offset(node);
  const double stretch = strain() * (node / (grid_.columns + 1));
  return grid_.element_size_m * Eigen::Vector2d(state_.qx[at], state_.qy[at] + stretch);
}

template <class Real>
Eigen::Vector2d ExplicitSolver<Real>::velocity_m_per_s(int node) const {
  const std::size_t at = node_offset(node);
  const double stretch = state_.grip_step * (node / (grid_.columns + 1)) / grid_.rows;
  return grid_.element_size_m / settings_.time_step_s * Eigen::Vector2d(state_.vx[at], state_.vy[at] + stretch);
}

template <class Real>
void ExplicitSolver<Real>::set_node(int node, const Eigen::Vector2d& displacement, const Eigen::Vector2d& velocity) {
  const std::size_t at = node_offset(node);
  const int row = node / (grid_.columns + 1);
  const Eigen::Vector2d q = displacement / grid_.element_size_m;
  const Eigen::Vector2d v = velocity * (settings_.time_step_s / grid_.element_size_m);
  state_.qx[at] = static_cast<Real>(q.x());
  state_.qy[at] = static_cast<Real>(q.y() - strain() * row);
  state_.vx[at] = static_cast<Real>(v.x());
  state_.vy[at] = static_cast<Real>(v.y() - state_.grip_step * row / grid_.rows);
}

template <class Real>
void ExplicitSolver<Real>::relax() {
  if (!extended_ || state_.overstress == Real{0}) return;
  // A step that retains none of Q leaves B = r f S, with which Q is 0 as long as S stays (extended_state.hpp). It is no
  // step of the test: nodes are put back, and its fictitious Q causes no softening.
  const std::size_t nodes = static_cast<std::size_t>(grid_.rows + 1) * static_cast<std::size_t>(state_.stride);
  const std::array<Real*, 4> moved = {state_.qx, state_.qy, state_.vx, state_.vy};
  std::array<std::vector<Real>, 4> before;
  for (std::size_t k = 0; k < moved.size(); ++k) before[k].assign(moved[k], moved[k] + nodes);
  const Real kept = std::exchange(state_.branch_kept, Real{0});
  Real* const onset = std::exchange(state_.onset, nullptr);
  state_.strain = static_cast<Real>(strain());
  extended_kernel_->advance(state_);
  state_.failed_count = 0;
  state_.branch_kept = kept;
  state_.onset = onset;
  for (std::size_t k = 0; k < moved.size(); ++k) std::ranges::copy(before[k], moved[k]);
}

/// Calls visit(H) with the displacement gradient at the four Gauss points of an element, `steps_ago` (0 to 1) of the
/// last step.
template <class Real>
template <class Visit>
void ExplicitSolver<Real>::visit_gradients(int element, double steps_ago, const Visit& visit) const {
  const ExplicitState<Real>& s = state_;
  const std::size_t at = static_cast<std::size_t>(element / s.columns) * s.stride + element % s.columns;
  const std::size_t offsets[4] = {at, at + 1, at + s.stride, at + s.stride + 1};
  Eigen::Matrix<double, 2, 4> corners;
  for (int corner = 0; corner < 4; ++corner) {
    const std::size_t node = offsets[corner];
    corners.col(corner) << s.qx[node] - steps_ago * s.vx[node], s.qy[node] - steps_ago * s.vy[node];
  }
  const double strain_then = strain() - steps_ago * settings_.strain_rate_per_s * settings_.time_step_s;
  for (int point = 0; point < 4; ++point) {
    Eigen::Matrix2d h = corners * shape_gradients(point);
    h(1, 1) += strain_then;
    visit(h);
  }
}

template <class Real>
double ExplicitSolver<Real>::smallest_volume_ratio(int element) const {
  double smallest = std::numeric_limits<double>::infinity();
  visit_gradients(element, 0.0, [&](const Eigen::Matrix2d& h) {
    const double ratio = 1.0 + material::volume_change(h);
    if (!(ratio >= smallest)) smallest = ratio;
  });
  return smallest;
}

template <class Real>
double ExplicitSolver<Real>::energy_density_j_per_m3(int element) const {
  if (is_empty(element)) return 0.0;
  const material::Lame lame = lame_of(grid_, element);
  const double eigenstrain = grid_.laws.eigenstrain.empty() ? 0.0 : grid_.laws.eigenstrain[element];
  double largest = 0.0;
  visit_gradients(element, 0.0, [&](const Eigen::Matrix2d& h) {
    const Eigen::Matrix2d elastic = (h - eigenstrain * Eigen::Matrix2d::Identity()) / (1.0 + eigenstrain);
    largest = std::max(largest, material::energy_density(elastic, lame));
  });
  return largest;
}

template <class Real>
double ExplicitSolver<Real>::element_energy(int element, double steps_ago) const {
  if (is_empty(element)) return 0.0;
  const material::Lame lame = lame_of(grid_, element);
  double mean = 0.0;
  visit_gradients(element, steps_ago,
                  [&](const Eigen::Matrix2d& h) { mean += 0.25 * material::energy_density(h, lame); });
  return mean * grid_.element_size_m * grid_.element_size_m;
}

template <class Real>
double ExplicitSolver<Real>::kinetic_energy() const {
  double sum = 0.0;
  const int nodes = (grid_.columns + 1) * (grid_.rows + 1);
  for (int node = 0; node < nodes; ++node) sum += velocity_m_per_s(node).squaredNorm();
  return 0.5 * settings_.density_kg_per_m3 * grid_.element_size_m * grid_.element_size_m * sum;
}

template <class Real>
double ExplicitSolver<Real>::stored_energy() const {
  double sum = 0.0;
  for (int element = 0; element < grid_.element_count(); ++element) sum += element_energy(element, 0.0);
  return sum;
}

template <class Real>
EnergyLedger ExplicitSolver<Real>::ledger() const {
  EnergyLedger now = ledger_;
  now.kinetic = kinetic_energy();
  now.stored = stored_energy();
  return now;
}

template class ExplicitSolver<float>;
template class ExplicitSolver<double>;

}  // namespace nacre::fem
