#pragma once
// Memory of one specimen for the explicit kernel.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fem/explicit_state.hpp"

namespace nacre::fem {

/// All arrays of an ExplicitState in one block aligned to cache lines, zero at first. For 200 x 160 elements in single
/// precision 1.0 MB.
template <class Real>
class ExplicitStorage {
 public:
  ExplicitStorage(int columns, int rows, bool with_ledger, bool with_energies = false);
  ExplicitStorage(ExplicitStorage&&) noexcept = default;
  ExplicitStorage& operator=(ExplicitStorage&&) noexcept = default;

  /// The state of a grid of that size, with its pointers into this block; everything else zero.
  ExplicitState<Real> state() const { return state_; }
  std::size_t bytes() const;

 private:
  Real* take(std::size_t count, std::size_t front);

  ExplicitState<Real> state_{};
  std::size_t size_ = 0, used_ = 0;
  std::vector<Real> memory_;
  Real* block_ = nullptr;  ///< in memory_
  std::vector<std::int32_t> failed_;
};

extern template class ExplicitStorage<float>;
extern template class ExplicitStorage<double>;

}  // namespace nacre::fem
