#include "material/pulled_bar.hpp"

#include <cmath>
#include <utility>

namespace nacre::material {

PulledBar::PulledBar(const ExtendedLaw& law, RelaxationFunction relaxation)
    : law_(law),
      is_elastic_(relaxation.is_elastic()),
      memory_(std::move(relaxation)),
      narrowing_(-law.lame.lambda_pa / (law.lame.lambda_pa + 2.0 * law.lame.mu_pa)),
      stiffness_pa_(law.lame.lambda_pa + 2.0 * law.lame.mu_pa) {}

double PulledBar::pull(double strain, double dt_s) {
  constexpr int kMostIterations = 60;
  constexpr double kWellKnown = 1e-14, kTellingStep = 1e-6;
  PointHistory trial;
  PointResponse response;
  const auto side_stress = [&](double sideways) {
    trial = history_;
    const Eigen::Matrix2d h = Eigen::Vector2d(sideways, strain).asDiagonal();
    response = respond(h, dt_s, law_, trial);
    return response.stress_pa(0, 0);
  };
  // Secant steps from where the last two steps lead; the stress sideways rises with the width.
  const double way = strain - strain_, last_way = strain_ - strain_before_;
  const bool goes_on = way * last_way > 0.0 && std::abs(way) < 2.0 * std::abs(last_way);
  const double narrowing = narrowing_ + (goes_on ? bend_ * (strain - strain_before_) : 0.0);
  double width = sideways_ + narrowing * way, stress = side_stress(width);
  for (int i = 0; i < kMostIterations; ++i) {
    const double next = width - stress / stiffness_pa_;
    if (!(std::abs(next - width) >= kWellKnown)) break;
    const double next_stress = side_stress(next), slope = (next_stress - stress) / (next - width);
    if (slope > 0.0) stiffness_pa_ = slope;
    width = next;
    stress = next_stress;
  }
  if (std::abs(way) > kTellingStep) {
    const double last = std::exchange(narrowing_, (width - sideways_) / way);
    bend_ = way * last_way > 0.0 ? (narrowing_ - last) / (way + last_way) : 0.0;
    strain_before_ = strain_;
  }
  strain_ = strain;
  sideways_ = width;
  history_ = trial;
  energy_ = response.failure_energy_j_per_m3;
  const double stress_pa = response.stress_pa(1, 1), area = history_.integrity * (1.0 + strain);
  if (is_elastic_ || area == 0.0) return stress_pa;
  return area * memory_.advance(stress_pa / area, dt_s);
}

}  // namespace nacre::material
