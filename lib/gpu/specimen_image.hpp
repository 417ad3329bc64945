#pragma once
// A mounted specimen on its way to a device: all its arrays in one block.

#include <cstdint>
#include <vector>

#include "gpu/specimen.hpp"

namespace nacre::fem {
template <class Real>
class ExplicitSolver;
}

namespace nacre::gpu {

struct SpecimenImage {
  std::vector<float> block;             ///< arrays one after the other, in the order of bind()
  std::size_t nodes = 0, elements = 0;  ///< numbers in an array of nodes, of elements
  Specimen specimen;                    ///< constants; its pointers only tell which arrays exist

  /// Numbers of device memory that the specimen takes: the block, the second velocities, and the corner forces.
  std::size_t device_numbers() const { return block.size() + 2 * nodes + 8 * elements; }
  /// The specimen with its pointers into `memory`, which holds device_numbers() numbers, the block first; failed_at is
  /// left to the caller.
  Specimen bind(float* memory) const;
};

/// The specimen of a solver that has made no step. `strain_per_step`: of the grips.
SpecimenImage image_of(const fem::ExplicitSolver<float>& solver, double strain_per_step);

/// Rows of `element_stride` numbers without their padding: by element of the grid.
std::vector<std::int32_t> by_element(const fem::ExtendedState<float>& state, const std::vector<std::int32_t>& padded);

}  // namespace nacre::gpu
