#include "material/pulled_bar.hpp"

#include <cmath>

namespace nacre::material {

double PulledBar::pull(double strain, double dt_s) {
  constexpr int kMostIterations = 60;
  PointHistory trial;
  PointResponse response;
  const auto side_stress = [&](double sideways) {
    trial = history_;
    const Eigen::Matrix2d h = Eigen::Vector2d(sideways, strain).asDiagonal();
    response = respond(h, dt_s, law_, trial);
    return response.stress_pa(0, 0);
  };
  // Secant steps from the last width; the stress sideways rises with the width.
  double last = sideways_, now = sideways_ + 1e-6;
  double last_stress = side_stress(last), now_stress = side_stress(now);
  for (int i = 0; i < kMostIterations && now_stress != last_stress && now_stress != 0.0; ++i) {
    const double next = now - now_stress * (now - last) / (now_stress - last_stress);
    last = now;
    last_stress = now_stress;
    now = next;
    now_stress = side_stress(now);
    if (std::abs(now - last) < 1e-14) break;
  }
  sideways_ = now;
  history_ = trial;
  energy_ = response.failure_energy_j_per_m3;
  const double stress_pa = response.stress_pa(1, 1), area = history_.integrity * (1.0 + strain);
  if (is_elastic_ || area == 0.0) return stress_pa;
  return area * memory_.advance(stress_pa / area, dt_s);
}

}  // namespace nacre::material
