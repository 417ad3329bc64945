#pragma once
// A bar of one material under uniaxial stress, with the history of its law.

#include "material/extended_law.hpp"
#include "material/relaxation_function.hpp"

namespace nacre::material {

/// Follows a history of strain step by step; flow, relaxation and softening are integrated over each step. Rate laws
/// act as the Maxwell branch does, on the second Piola-Kirchhoff stress along the bar: there is none sideways.
class PulledBar {
 public:
  explicit PulledBar(const ExtendedLaw& law, RelaxationFunction relaxation = {});

  /// Stretches the bar to a nominal strain (F22 - 1 > -1) within `dt_s`, its width free; returns the nominal stress,
  /// Pa. Not finite where the law has no state, as beyond the limit of its chains.
  double pull(double strain, double dt_s);

  double sideways() const { return sideways_; }  ///< F11 - 1
  double failure_energy_j_per_m3() const { return energy_; }
  const PointHistory& history() const { return history_; }

 private:
  ExtendedLaw law_;
  bool is_elastic_;  ///< the memory keeps everything
  FadingMemory memory_;
  PointHistory history_;
  double strain_ = 0.0, sideways_ = 0.0, energy_ = 0.0;
  double narrowing_;            ///< d sideways / d strain over the last step
  double strain_before_ = 0.0;  ///< where that step began
  double bend_ = 0.0;           ///< second divided difference of sideways over the last two steps
  double stiffness_pa_;         ///< d stress sideways / d sideways
};

}  // namespace nacre::material
