#pragma once
// Explicit dynamics with fracture on a grid (thesis 2.3.1): total Lagrangian, four-node squares with 2 x 2 Gauss
// points, compressible neo-Hookean law, equal mass at every node, symplectic Euler, elements that fail by strain energy
// density.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "base/result.hpp"
#include "fem/explicit_storage.hpp"
#include "fem/extended_storage.hpp"
#include "fem/grid.hpp"
#include "fem/neighbourhood.hpp"
#include "fem/simd_level.hpp"

namespace nacre::fem {

/// Speed of the fastest elastic wave in any element that is not empty, sqrt((lambda + 2 mu) / rho), m/s; with an
/// extended law that of its stiffest state before failure.
double fastest_wave_m_per_s(const Grid& grid, double density_kg_per_m3);

/// The longest step that waves allow with some reserve: 0.8 of the stability limit h / c.
double longest_step_s(const Grid& grid, double density_kg_per_m3);

/// Loading and integration of a grid. The bottom row of nodes is held vertically, the top row moves at
/// strain_rate x height; horizontal motion is free. Velocities start from the linear profile between the grips, so that
/// no shock starts, displacements from the uniform stretch `initial_strain`.
struct ExplicitSettings {
  double density_kg_per_m3 = 1150.0;
  double time_step_s = 0.0;
  double strain_rate_per_s = 0.0;
  double initial_strain = 0.0;
  Damping damping = Damping::smoothing;
  double gamma_per_s = 0.0;
  double largest_courant_number =
      1.0;                        ///< time steps above this times h / c are refused (1 is the linear stability limit)
  bool keep_ledger = false;       ///< account for energies, at some cost in time
  std::optional<SimdLevel> simd;  ///< best_simd_level() when absent
};

/// The result of one step, at the strain it started from.
struct StepReport {
  double strain = 0.0;
  double top_stress_pa = 0.0;     ///< vertical reaction of the upper grip over the initial width, tension positive
  double bottom_stress_pa = 0.0;  ///< of the lower grip
  int failed = 0;                 ///< elements that passed their threshold; they are empty from the next step on
  /// Mean of both grips: the reaction in the frame of the specimen's middle, free of waves that run through it as a
  /// whole.
  double stress_pa() const { return 0.5 * (top_stress_pa + bottom_stress_pa); }
};

/// Energies per unit thickness, J/m; kept when ExplicitSettings::keep_ledger is set.
/// work + initial_kinetic + initial_stored = kinetic + stored + damped + fractured, up to the integration's error.
struct EnergyLedger {
  double work = 0.0;             ///< done by the grips
  double initial_kinetic = 0.0;  ///< of the linear velocity profile
  double initial_stored = 0.0;
  double kinetic = 0.0;
  double stored = 0.0;     ///< in the intact elements
  double damped = 0.0;     ///< taken out by the damping
  double fractured = 0.0;  ///< stored in elements when they failed
};

/// Real is float (the testers) or double (comparison, the explicit modulus).
template <class Real>
class ExplicitSolver {
 public:
  /// A grid with laws of its own (Grid::laws) or the neighbourhood criterion goes through other kernels, without a
  /// ledger.
  /// Error: a time step beyond stability, alpha = gamma dt > 3/4 (Eq. 2.4), constants that are not usable, a ledger for
  /// an extended law or a neighbourhood.
  static Result<ExplicitSolver> create(const Grid& grid, const ExplicitSettings& settings);
  ExplicitSolver(ExplicitSolver&&) noexcept;
  ~ExplicitSolver();

  /// Advances by one time step. Allocates nothing. Error: blow-up (J <= 0 or not a number in an element), with step and
  /// element; found at once when the element passes its threshold, else within 16 steps.
  Result<StepReport> step();
  /// Checks for blow-up now, as step() does every 16 steps.
  Result<void> check() const;

  /// The state on which the kernel works, for running it elsewhere: the pointers are into this solver. With an extended
  /// law the pointers of its parts are set.
  const ExtendedState<Real>& state() const { return state_; }
  bool has_extended_law() const { return extended_ != nullptr; }
  /// Stress, Pa, of a grip whose vertical reaction is 1 in the state's unit.
  double stress_unit_pa() const;

  std::int64_t steps() const { return steps_; }
  /// Nominal strain of the grips now.
  double strain() const;
  /// The elements that failed in the last step, as indices of the grid.
  std::vector<int> last_failed() const;
  bool is_empty(int element) const;

  /// Nodal values in the laboratory frame, by node = row * (columns + 1) + column.
  Eigen::Vector2d displacement_m(int node) const;
  Eigen::Vector2d velocity_m_per_s(int node) const;
  /// Replaces displacement and velocity of a node, for verification.
  void set_node(int node, const Eigen::Vector2d& displacement_m, const Eigen::Vector2d& velocity_m_per_s);
  /// Sets the Maxwell branch to its relaxed state, with no overstress at the present positions of the nodes.
  void relax();

  /// Largest elastic energy density of Eq. 2.1 at the quadrature points of an element, less its eigenstrain, J/m^3; 0
  /// when it is empty.
  double energy_density_j_per_m3(int element) const;
  /// The energies now.
  EnergyLedger ledger() const;

 private:
  ExplicitSolver(const Grid& grid, const ExplicitSettings& settings);
  double element_scale() const;  ///< unit of the state's mu over Pa
  void fill_elements();
  void advance();
  void erase_failed();
  tl::unexpected<Error> blow_up(int element) const;
  double kinetic_energy() const;
  double stored_energy() const;
  template <class Visit>
  void visit_gradients(int element, double steps_ago, const Visit& visit) const;
  double element_energy(int element, double steps_ago) const;
  double smallest_volume_ratio(int element) const;
  std::size_t node_offset(int node) const;

  Grid grid_;
  ExplicitSettings settings_;
  const ExplicitKernel<Real>* kernel_ = nullptr;
  ExplicitStorage<Real> storage_;
  std::unique_ptr<ExtendedStorage<Real>> extended_;  ///< null without extended law
  const ExtendedKernel<Real>* extended_kernel_ = nullptr;
  std::optional<Neighbourhood<Real>> neighbourhood_;  ///< of that criterion
  ExtendedState<Real> state_{};
  std::int64_t steps_ = 0;
  EnergyLedger ledger_;
};

extern template class ExplicitSolver<float>;
extern template class ExplicitSolver<double>;

}  // namespace nacre::fem
