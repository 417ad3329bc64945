#include "laboratory/fracture_bench.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <optional>

#include "laboratory/hidden_specimen.hpp"
#include "laboratory/neighbourhood.hpp"

namespace nacre::laboratory {
namespace {

constexpr double kDensity = 1150.0;  // kg/m^3, both phases
constexpr double kTimeStepSafety = 0.7;
constexpr double kWindowStrain = 5e-5;  // one recorded point
constexpr std::size_t kSmoothingWindows = 10;
constexpr double kSeparation = 0.2;           // of the peak stress
constexpr double kEarliestSeparation = 2e-3;  // before it, ringing of the start may not end a test
/// Largest damping ratio of the grid's fastest mode; beyond it the step would shrink for nothing.
constexpr double kDampingRatioLimit = 1.0;
/// Time in which shrunk material comes to rest, in transits of its fastest wave, and how fast the grips give way.
constexpr double kRestTransits = 40.0, kGripYielding = 0.5;

/// Fastest wave and what it allows: sqrt((lambda + 2 mu) / rho) of the stiffest element.
double fastest_wave(const Raster& raster) {
  double stiffest = 0.0;
  for (std::size_t e = 0; e < raster.mu_pa.size(); ++e) {
    stiffest = std::max(stiffest, hidden_stiffening(raster, e) * (raster.lambda_pa[e] + 2.0 * raster.mu_pa[e]));
  }
  return std::sqrt(stiffest / kDensity);
}

/// Central differences with a viscous stress are stable below 2/omega (sqrt(1 + xi^2) - xi), xi the damping ratio at
/// the grid's highest frequency omega = 2 c / h.
struct TimeStep {
  double dt_s = 0.0;
  double viscosity_pa_s = 0.0;
};

TimeStep time_step(double wave_m_per_s, double gamma_per_s) {
  const double omega = 2.0 * wave_m_per_s / kElementM;
  // (2.4) adds gamma h^2 / 3 to the kinematic viscosity, h being the tester's element; k^2 <= 8 / h^2 here.
  const double kinematic = gamma_per_s * kTesterElementM * kTesterElementM / 3.0;
  const double wavenumber_squared = 8.0 / (kElementM * kElementM);
  const double ratio = std::min(kinematic * wavenumber_squared / (2.0 * omega), kDampingRatioLimit);
  return {.dt_s = kTimeStepSafety * 2.0 / omega * (std::sqrt(1.0 + ratio * ratio) - ratio),
          .viscosity_pa_s = kDensity * ratio * 2.0 * omega / wavenumber_squared};
}

/// Nodes and elements of the specimen, rows padded so that a vector may read past the last column.
class SpecimenMesh {
 public:
  SpecimenMesh(const Raster& raster, const TimeStep& step)
      : columns_(raster.columns),
        rows_(raster.rows),
        stride_(static_cast<std::size_t>(raster.columns) + 32),
        step_(step),
        grips_(raster.grips) {
    const std::size_t nodes = stride_ * static_cast<std::size_t>(rows_ + 1);
    for (std::vector<float>* field : {&wx_, &wy_, &vx_, &vy_, &mu_, &lambda_, &threshold_}) field->assign(nodes, 0.0f);
    for (std::vector<float>& row : force_) row.assign(stride_, 0.0f);
    unused_energy_.assign(stride_, 0.0f);
    if (raster.neighbourhood_m > 0.0) neighbourhood_.emplace(raster, stride_);
    inverse_mass_.assign(stride_, 1.0f);
    inverse_mass_.front() = inverse_mass_[columns_] = 2.0f;  // half a node's share at the edges
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        const auto from = static_cast<std::size_t>(row * columns_ + column),
                   to = at(row) + static_cast<std::size_t>(column);
        mu_[to] = static_cast<float>(raster.mu_pa[from]);
        lambda_[to] = static_cast<float>(raster.lambda_pa[from]);
        threshold_[to] = neighbourhood_ ? std::numeric_limits<float>::infinity()
                                        : static_cast<float>(std::min<double>(raster.threshold_j_per_m3[from],
                                                                              std::numeric_limits<float>::max()));
      }
    }
  }

  /// Adds the hidden effects of the material; `state` must outlive the specimen's steps.
  void hide(HiddenSpecimen* state) { hidden_ = state; }
  /// Slows all motion down, to come to rest.
  void brake(float share) {
    for (std::vector<float>* velocity : {&vx_, &vy_})
      for (float& value : *velocity) value *= 1.0f - share;
  }

  /// One time step at grip strain `strain`. Returns the mean nominal stress of both grips, Pa. Error: blow-up, with the
  /// row.
  Result<double> advance(double strain) {
    const ElementStep elements{.grip_strain = static_cast<float>(strain),
                               .half_inverse_edge = static_cast<float>(0.5 / kElementM),
                               .viscosity = static_cast<float>(step_.viscosity_pa_s)};
    const float dt = static_cast<float>(step_.dt_s);
    const float scale = static_cast<float>(step_.dt_s / (8.0 * kDensity * kElementM));  // dt h/8 / (rho h^2)
    std::ranges::fill(force_[kCarryX], 0.0f);
    std::ranges::fill(force_[kCarryY], 0.0f);
    double bottom = 0.0;
    for (int row = 0; row < rows_; ++row) {
      const int outcome = hidden_ == nullptr ? advance_elements(element_row(row), elements)
                                             : hidden_->advance(row, element_row(row), elements);
      if (outcome < 0) return fail("an element of row {} turned inside out", row);
      const bool grip = row == 0;
      advance_nodes(node_row(row), grip ? 2.0f * scale : scale, grip ? 0.0f : scale, dt, force_[kTotalY].data());
      if (grip) bottom = grip_force();
    }
    if (neighbourhood_) neighbourhood_->settle(mu_, lambda_, hidden_);
    for (std::size_t k = 0; k < kCarryX; ++k) std::ranges::fill(force_[k], 0.0f);  // no elements above the top grip
    advance_nodes(node_row(rows_), 2.0f * scale, 0.0f, dt, force_[kTotalY].data());
    hold_in_grips(strain);
    // Forces are in units of h/8; the width is columns h.
    return 0.5 * (grip_force() - bottom) / (8.0 * columns_);
  }

  std::int64_t element_count() const { return static_cast<std::int64_t>(columns_) * rows_; }

 private:
  enum Force : std::size_t { kXLower, kXUpper, kXAxial, kYLower, kYUpper, kYAxial, kCarryX, kCarryY, kTotalY, kForces };

  std::size_t at(int row) const { return stride_ * static_cast<std::size_t>(row); }

  double grip_force() const {
    const auto& total = force_[kTotalY];
    return std::accumulate(total.begin(), total.begin() + columns_ + 1, 0.0);
  }

  /// What the grips do beyond moving apart: hold sideways, and tilt.
  void hold_in_grips(double strain) {
    if (grips_.side_stiffness_pa > 0.0) {
      const auto pull_back =
          static_cast<float>(2.0 * step_.dt_s * grips_.side_stiffness_pa / (kDensity * kElementM * kElementM));
      for (const int row : {0, rows_})
        for (int column = 0; column <= columns_; ++column) {
          const std::size_t n = at(row) + static_cast<std::size_t>(column);
          vx_[n] -= pull_back * wx_[n];
        }
    }
    if (grips_.tilt == 0.0) return;
    for (int column = 0; column <= columns_; ++column) {
      const double from_middle = static_cast<double>(column) / columns_ - 0.5;
      wy_[at(rows_) + static_cast<std::size_t>(column)] =
          static_cast<float>(grips_.tilt * from_middle * strain * rows_ * kElementM);
    }
  }

  ElementRow element_row(int row) {
    const std::size_t lower = at(row), upper = at(row + 1);
    return {.columns = columns_,
            .wx_lower = &wx_[lower],
            .wy_lower = &wy_[lower],
            .wx_upper = &wx_[upper],
            .wy_upper = &wy_[upper],
            .vx_lower = &vx_[lower],
            .vy_lower = &vy_[lower],
            .vx_upper = &vx_[upper],
            .vy_upper = &vy_[upper],
            .mu = &mu_[lower],
            .lambda = &lambda_[lower],
            .threshold = &threshold_[lower],
            .energy = neighbourhood_ ? neighbourhood_->energy_row(row) : unused_energy_.data(),
            .x_lower = force_[kXLower].data(),
            .x_upper = force_[kXUpper].data(),
            .x_axial = force_[kXAxial].data(),
            .y_lower = force_[kYLower].data(),
            .y_upper = force_[kYUpper].data(),
            .y_axial = force_[kYAxial].data()};
  }

  NodeRow node_row(int row) {
    const std::size_t n = at(row);
    return {.columns = columns_,
            .x_lower = force_[kXLower].data(),
            .x_upper = force_[kXUpper].data(),
            .x_axial = force_[kXAxial].data(),
            .y_lower = force_[kYLower].data(),
            .y_upper = force_[kYUpper].data(),
            .y_axial = force_[kYAxial].data(),
            .carry_x = force_[kCarryX].data(),
            .carry_y = force_[kCarryY].data(),
            .wx = &wx_[n],
            .wy = &wy_[n],
            .vx = &vx_[n],
            .vy = &vy_[n],
            .inverse_mass = inverse_mass_.data()};
  }

  int columns_, rows_;
  std::size_t stride_;
  TimeStep step_;
  Grips grips_;
  HiddenSpecimen* hidden_ = nullptr;
  std::optional<Neighbourhood> neighbourhood_;
  std::vector<float> wx_, wy_, vx_, vy_, mu_, lambda_, threshold_, inverse_mass_, unused_energy_;
  std::array<std::vector<float>, kForces> force_;
};

/// The recorder of the testing machine: averages over windows of strain, and whether the specimen has separated.
class CurveRecorder {
 public:
  void record(double strain, double stress_pa) {
    curve.strain.push_back(strain);
    curve.stress_pa.push_back(stress_pa);
    recent_.push_back(stress_pa);
    if (recent_.size() > kSmoothingWindows) recent_.pop_front();
    smooth_ = std::accumulate(recent_.begin(), recent_.end(), 0.0) / static_cast<double>(recent_.size());
    peak_ = std::max(peak_, smooth_);
  }
  bool separated() const {
    return !curve.empty() && curve.strain.back() > kEarliestSeparation && smooth_ < kSeparation * peak_;
  }
  tester::Curve curve{.strain = {0.0}, .stress_pa = {0.0}};

 private:
  std::deque<double> recent_;
  double smooth_ = 0.0, peak_ = 0.0;
};

/// Lets a specimen of shrunk material come to rest between grips that give way to its force; returns their strain.
Result<double> come_to_rest(SpecimenMesh& specimen, HiddenSpecimen& hidden, const Raster& raster, double gamma_per_s) {
  if (raster.law.eigenstrain.empty()) return 0.0;
  const double wave = fastest_wave(raster),
               transit_steps = raster.rows * kElementM / wave / time_step(wave, gamma_per_s).dt_s;
  const double stiffness_pa = mean_modulus(raster);
  const auto steps = static_cast<std::int64_t>(kRestTransits * transit_steps);
  double strain = 0.0;
  for (std::int64_t n = 1; n <= steps; ++n) {
    hidden.shrink(std::min(1.0, 2.0 * static_cast<double>(n) / static_cast<double>(steps)));
    const Result<double> stress_pa = specimen.advance(strain);
    if (!stress_pa) return stress_pa;
    strain -= kGripYielding / transit_steps * *stress_pa / stiffness_pa;
    specimen.brake(static_cast<float>(1.0 / transit_steps));
  }
  specimen.brake(1.0f);
  return strain;
}

}  // namespace

Result<PulledSpecimen> pull_to_separation(const Raster& raster, const Pull& pull) {
  const TimeStep step = time_step(fastest_wave(raster), pull.gamma_per_s);
  SpecimenMesh specimen(raster, step);
  std::optional<HiddenSpecimen> hidden;
  if (raster.law.any()) specimen.hide(&hidden.emplace(raster, step.dt_s));
  double rest_strain = 0.0;
  if (hidden) {
    const Result<double> rest = come_to_rest(specimen, *hidden, raster, pull.gamma_per_s);
    if (!rest) return fail("before it was mounted: {}", rest.error().message);
    rest_strain = *rest;
  }
  const double strain_step = pull.strain_rate_per_s * step.dt_s;
  const auto window = std::max<std::int64_t>(1, std::llround(kWindowStrain / strain_step));
  CurveRecorder recorder;
  double sum_pa = 0.0;
  for (std::int64_t n = 1; n <= pull.step_limit; ++n) {
    const Result<double> stress_pa =
        specimen.advance(rest_strain + (1.0 + rest_strain) * strain_step * static_cast<double>(n));
    if (!stress_pa) return fail("step {}: {}", n, stress_pa.error().message);
    sum_pa += *stress_pa;
    if (n % window != 0) continue;
    // The mean over a window belongs to the strain at its middle.
    recorder.record(strain_step * (static_cast<double>(n) - 0.5 * static_cast<double>(window - 1)),
                    sum_pa / static_cast<double>(window));
    sum_pa = 0.0;
    const bool separated = recorder.separated();
    if (separated || recorder.curve.strain.back() >= pull.strain_limit) {
      return PulledSpecimen{.curve = std::move(recorder.curve),
                            .separated = separated,
                            .steps = n,
                            .element_count = specimen.element_count()};
    }
  }
  return fail("no end after {} steps at strain {:.3f}", pull.step_limit, recorder.curve.strain.back());
}

}  // namespace nacre::laboratory
