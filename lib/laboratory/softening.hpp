#pragma once
// What failing elements of the laboratory keep of their stress; for the inner loops alone.

#include <cmath>

#include "laboratory/fracture_kernel.hpp"

namespace nacre::laboratory {

/// Which law it is, as weights: choices between three would keep the loop from becoming vector code.
struct SofteningShape {
  float v, w, linear, drawn_out, none;
  explicit SofteningShape(const SofteningLaw& law)
      : v(law.linear > 1e-6f ? law.linear : 1e-6f),
        w(law.drawn_out > 1e-6f ? law.drawn_out : 1e-6f),
        linear(law.linear > 0.0f && law.drawn_out == 0.0f ? 1.0f : 0.0f),
        drawn_out(law.drawn_out > 0.0f ? 1.0f : 0.0f),
        none(1.0f - linear - drawn_out) {}
};

/// The share of stress that is left at this energy density (J/m^3), of what was left before.
[[gnu::always_inline]] inline float soften(float integrity, float energy, float onset, const SofteningShape& shape) {
  const float s = std::sqrt((energy > 0.0f ? energy : 0.0f) / onset);
  const float falling = (1.0f + shape.v - s) / (s * shape.v);
  const float x = 1.0f + (s - 1.0f) / shape.w;
  const float left = shape.linear * (falling > 0.0f ? falling : 0.0f) + shape.drawn_out / (x * x * x * s) + shape.none;
  const float now = s > 1.0f ? left : 1.0f;
  return now < integrity ? now : integrity;
}

/// What has softened to a tenth and is squeezed to a tenth of its area is gone: a long tail would keep it until it
/// turns inside out.
[[gnu::always_inline]] inline bool is_spent(float integrity, float jacobian) {
  return (integrity < 0.1f) & (jacobian < 0.1f);
}

/// The energy density (J/m^3) above which an element fails: any, of one that is spent. Beside a comparison of the
/// energy a second condition of failure would keep GCC from making the loop over elements vector code.
[[gnu::always_inline]] inline float failure_energy(float threshold, float integrity, float jacobian) {
  return is_spent(integrity, jacobian) ? -1.0f : threshold;
}

}  // namespace nacre::laboratory
