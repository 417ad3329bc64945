#pragma once
// A bar of one material under uniaxial stress, with the history of its law.

#include "material/extended_law.hpp"

namespace nacre::material {

/// Follows a history of strain step by step; flow, relaxation and softening are integrated over each step.
class PulledBar {
 public:
  explicit PulledBar(const ExtendedLaw& law) : law_(law) {}

  /// Stretches the bar to a nominal strain (F22 - 1 > -1) within `dt_s`, its width free; returns the nominal stress,
  /// Pa. Not finite where the law has no state, as beyond the limit of its chains.
  double pull(double strain, double dt_s);

  double sideways() const { return sideways_; }  ///< F11 - 1
  double failure_energy_j_per_m3() const { return energy_; }
  const PointHistory& history() const { return history_; }

 private:
  ExtendedLaw law_;
  PointHistory history_;
  double sideways_ = 0.0, energy_ = 0.0;
};

}  // namespace nacre::material
