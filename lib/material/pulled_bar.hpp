#pragma once
// A bar of one material under uniaxial stress, with the history of its law.

#include "material/extended_law.hpp"
#include "material/relaxation_function.hpp"

namespace nacre::material {

/// Follows a history of strain step by step; flow, relaxation and softening are integrated over each step. Rate laws
/// act as the Maxwell branch does, on the second Piola-Kirchhoff stress along the bar: there is none sideways.
class PulledBar {
 public:
  explicit PulledBar(const ExtendedLaw& law, RelaxationFunction relaxation = {})
      : law_(law), is_elastic_(relaxation.is_elastic()), memory_(std::move(relaxation)) {}

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
  double sideways_ = 0.0, energy_ = 0.0;
};

}  // namespace nacre::material
