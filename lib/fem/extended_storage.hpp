#pragma once
// Memory that the extended law needs beyond ExplicitStorage; none for parts of the law that are off.

#include <vector>

#include "fem/extended_state.hpp"
#include "fem/grid.hpp"

namespace nacre::fem {

template <class Real>
class ExtendedStorage {
 public:
  /// Arrays for the laws of a grid, filled from it, with the pointers and constants in `state` set. `scale`: unit of
  /// state.mu over Pa; `time_step_s` 0: the branch stays out (statics). The state's mu must be filled.
  ExtendedStorage(const Grid& grid, double scale, double time_step_s, ExtendedState<Real>& state);

 private:
  Real* take(double value);
  void fill_constants(const Grid& grid, double scale, ExtendedState<Real>& state);
  void take_history(const GridLaws& laws, double time_step_s, ExtendedState<Real>& state);

  std::size_t elements_ = 0;
  std::vector<std::vector<Real>> arrays_;
};

/// Removes every law from an element of the state, as if it had been empty from the start.
template <class Real>
void erase_laws(ExtendedState<Real>& state, int element);

extern template class ExtendedStorage<float>;
extern template class ExtendedStorage<double>;
extern template void erase_laws<float>(ExtendedState<float>&, int);
extern template void erase_laws<double>(ExtendedState<double>&, int);

}  // namespace nacre::fem
