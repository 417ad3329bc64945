#pragma once
// One time step of a batch, as functions of one thread's place: cuda_device.cu calls them from kernels,
// emulated_device.cpp from loops. The law is that of the CPU's kernel, from the same source (fem/explicit_law.ipp,
// fem/extended_law.ipp).
//
// A step is two passes. Elements: forces on the four corners, failure. Nodes, a tile per block of threads: v += f into
// the block's own memory, one node further on every side; then, after a barrier, the filter of Eq. 2.4 and the motion.
// Velocities go from one buffer to the other, so that neighbouring tiles read those of the step before.

#include <cmath>
#include <cstdint>
#include <cstring>

#include "gpu/specimen.hpp"

namespace nacre::gpu {

namespace scalar {
using namespace nacre::fem;
// clang-format off: the packs come first
#include "fem/scalar_packs.hpp"
#include "fem/explicit_law.ipp"
#include "fem/extended_law.ipp"
// clang-format on
}  // namespace scalar

/// Nodes of a tile, and threads that work on it.
inline constexpr int kTileColumns = 32, kTileRows = 8, kTileThreads = kTileColumns * kTileRows;
/// With a node more on every side.
inline constexpr int kRimColumns = kTileColumns + 2, kRimRows = kTileRows + 2;
/// Partial sums of a grip's reaction.
inline constexpr int kShares = 32;

/// Memory that the threads of a tile share.
struct Tile {
  float vx[kRimRows][kRimColumns], vy[kRimRows][kRimColumns];
  float share[2][kShares];
};

/// The grips' strain in step `step`, for the state that the passes are given.
NACRE_INLINE float strain_at(const Specimen& specimen, std::int64_t step) {
  return static_cast<float>(specimen.initial_strain + specimen.strain_per_step * static_cast<double>(step));
}

NACRE_INLINE int tiles_across(const Specimen& specimen) {
  return (specimen.state.columns + kTileColumns) / kTileColumns;
}
NACRE_INLINE int tiles_of(const Specimen& specimen) {
  return tiles_across(specimen) * ((specimen.state.rows + kTileRows) / kTileRows);
}

/// An element that failed has no law from the next step on.
NACRE_INLINE void erase(const fem::ExtendedState<float>& s, int element) {
  const float never = INFINITY;
  s.mu[element] = s.lambda[element] = 0.0f;
  s.threshold[element] = never;
  if (s.eigenstrain) s.eigenstrain[element] = 0.0f;
  if (s.inverse_limit) s.inverse_limit[element] = 0.0f;
  if (s.flow_strain) s.flow_strain[element] = never;
  if (s.onset) s.onset[element] = never;
  if (s.overstress == 0.0f) return;
  for (int point = 0; point < 4; ++point)
    for (int i = 0; i < 3; ++i) s.branch[point][i][element] = 0.0f;
}

/// Whether an element is inverted (J <= 0), or not a number.
NACRE_INLINE bool is_inverted(const fem::ExtendedState<float>& s, int node) {
  const scalar::Gradient<float> g = scalar::gradient<float>(s, node);
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k)
      if (!(scalar::volume_change<float>(g, i, k) > -1.0f)) return true;
  return false;
}

/// First pass: the element at `row`, `column`; notes in `inverted`, unless that names another, that it failed with
/// J <= 0, which is blow-up.
NACRE_INLINE void step_element(const Specimen& specimen, std::int64_t step, int row, int column,
                               std::int32_t& inverted) {
  const fem::ExtendedState<float>& s = specimen.state;
  const int element = row * s.element_stride + column, node = row * s.stride + column;
  scalar::EdgeForces<float> f{};
  if (s.mu[element] != 0.0f) {
    const auto nothing = [] {};
    f = specimen.extended ? scalar::Extended<float, true>::forces(s, node, element, nothing)
                          : scalar::NeoHookean<float>::forces(s, node, element, nothing);
    if (!(f.energy <= s.threshold[element])) {
      if (inverted < 0 && is_inverted(s, node)) inverted = row * s.columns + column;
      specimen.failed_at[element] = static_cast<std::int32_t>(step);
      erase(s, element);
    }
  } else if (inverted < 0 && specimen.failed_at[element] == step - 1 && step > 0 && is_inverted(s, node)) {
    inverted = row * s.columns + column;  // by the motion of the step that it failed in
  }
  const float forces[8] = {f.bottom_x + f.left_x, f.right_x - f.bottom_x, f.top_x - f.left_x, -(f.top_x + f.right_x),
                           f.bottom_y + f.left_y, f.right_y - f.bottom_y, f.top_y - f.left_y, -(f.top_y + f.right_y)};
  for (int i = 0; i < 8; ++i) specimen.corner[i][element] = forces[i];
}

/// Force on a node along one direction; `corner`: the four arrays of that direction. Summed so that mirroring a
/// specimen mirrors every bit.
NACRE_INLINE float force_on(const fem::ExtendedState<float>& s, float* const* corner, int row, int column) {
  const bool above = row<s.rows, below = row> 0, right = column<s.columns, left = column> 0;
  const int element = row * s.element_stride + column;
  const float up = (above && right ? corner[0][element] : 0.0f) + (above && left ? corner[1][element - 1] : 0.0f);
  const float down = (below && right ? corner[2][element - s.element_stride] : 0.0f) +
                     (below && left ? corner[3][element - s.element_stride - 1] : 0.0f);
  return up + down;
}

/// Second pass, first part: velocities of a tile and its rim.
NACRE_INLINE void gather_velocities(const Specimen& specimen, std::int64_t step, int tile_index, int thread,
                                    Tile& tile) {
  const fem::ExtendedState<float>& s = specimen.state;
  const float* const vx = step % 2 == 0 ? s.vx : specimen.other_vx;
  const float* const vy = step % 2 == 0 ? s.vy : specimen.other_vy;
  const int first_row = tile_index / tiles_across(specimen) * kTileRows - 1,
            first_column = tile_index % tiles_across(specimen) * kTileColumns - 1;
  for (int i = thread; i < kRimRows * kRimColumns; i += kTileThreads) {
    const int row = first_row + i / kRimColumns, column = first_column + i % kRimColumns;
    float x = 0.0f, y = 0.0f;
    if (row >= 0 && row <= s.rows && column >= 0 && column <= s.columns) {
      const int node = row * s.stride + column;
      x = vx[node] + force_on(s, specimen.corner, row, column);
      // The grips move no node vertically.
      y = row == 0 || row == s.rows ? vy[node] : vy[node] + force_on(s, specimen.corner + 4, row, column);
    }
    tile.vx[i / kRimColumns][i % kRimColumns] = x;
    tile.vy[i / kRimColumns][i % kRimColumns] = y;
  }
}

/// A thread's share of both grips' reactions, tension positive; by the first kShares threads of the first tile.
NACRE_INLINE void share_reactions(const Specimen& specimen, int thread, Tile& tile) {
  const fem::ExtendedState<float>& s = specimen.state;
  float bottom = 0.0f, top = 0.0f;
  for (int column = thread; column < s.columns; column += kShares) {
    const int last = (s.rows - 1) * s.element_stride + column;
    bottom += specimen.corner[4][column] + specimen.corner[5][column];
    top -= specimen.corner[6][last] + specimen.corner[7][last];
  }
  tile.share[0][thread] = bottom;
  tile.share[1][thread] = top;
}

NACRE_INLINE float reaction(const Tile& tile, int grip) {
  double sum = 0.0;
  for (int i = 0; i < kShares; ++i) sum += tile.share[grip][i];
  return static_cast<float>(sum);
}

/// Eq. 2.4 in one direction: a node's velocity and those around it.
NACRE_INLINE float smoothed(const float (&v)[kRimRows][kRimColumns], int row, int column, float weight) {
  const auto sum_of_three = [&](int r) { return (v[r][column - 1] + v[r][column + 1]) + v[r][column]; };
  const float box = (sum_of_three(row - 1) + sum_of_three(row + 1)) + sum_of_three(row), old = v[row][column];
  return scalar::fma(weight, scalar::fma(1.0f / 9, box, -old), old);
}

/// Second pass, second part: the node that belongs to `thread`.
NACRE_INLINE void damp_and_move(const Specimen& specimen, std::int64_t step, int tile_index, int thread,
                                const Tile& tile) {
  const fem::ExtendedState<float>& s = specimen.state;
  const int in_row = thread / kTileColumns + 1, in_column = thread % kTileColumns + 1;
  const int row = tile_index / tiles_across(specimen) * kTileRows + in_row - 1,
            column = tile_index % tiles_across(specimen) * kTileColumns + in_column - 1;
  if (row > s.rows || column > s.columns) return;
  const int node = row * s.stride + column;
  float x = tile.vx[in_row][in_column], y = tile.vy[in_row][in_column];
  if (s.damping == fem::Damping::exponential) {
    x *= s.decay, y *= s.decay;
  } else if (row > 0 && row < s.rows) {
    x = smoothed(tile.vx, in_row, in_column, s.row.weight[column]);
    y = smoothed(tile.vy, in_row, in_column, s.row.weight[column]);
  }
  (step % 2 == 0 ? specimen.other_vx : s.vx)[node] = x;
  (step % 2 == 0 ? specimen.other_vy : s.vy)[node] = y;
  s.qx[node] += x;
  s.qy[node] += y;
}

}  // namespace nacre::gpu
