#pragma once
// A specimen as a device holds it: plain data that host and device code share.

#include <cstdint>

#include "fem/extended_state.hpp"

namespace nacre::gpu {

/// Steps between two reports on the specimens of a batch.
inline constexpr int kChunkSteps = 64;

/// One place of a batch. Pointers are into the device's memory; arrays of nodes and elements are laid out as in
/// fem::ExplicitState.
struct Specimen {
  fem::ExtendedState<float> state{};               ///< velocities at even steps, displacements, constants, history
  float *other_vx = nullptr, *other_vy = nullptr;  ///< velocities at odd steps
  /// Forces of every element on its corners (bottom-left, bottom-right, top-left, top-right) along x, then along y;
  /// rows x element_stride each.
  float* corner[8] = {};
  std::int32_t* failed_at = nullptr;  ///< step in which an element failed, -1 while it is intact; rows x element_stride
  double initial_strain = 0.0, strain_per_step = 0.0;
  std::int64_t begun_at = 0;  ///< step of the device that is this specimen's step 0
  bool extended = false;      ///< its elements follow the extended law
  bool occupied = false;
};

}  // namespace nacre::gpu
