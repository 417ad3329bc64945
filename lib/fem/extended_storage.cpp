#include "fem/extended_storage.hpp"

#include <cmath>
#include <limits>

namespace nacre::fem {
namespace {

template <class Real>
constexpr Real kNever = std::numeric_limits<Real>::infinity();

/// Calls visit(element of the grid, its place in the state's arrays) for every element that is not empty.
template <class Real, class Visit>
void for_every_element(const Grid& grid, const ExtendedState<Real>& state, const Visit& visit) {
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const int element = grid.index(row, column);
      if (grid.phase[element] != Phase::empty) visit(element, row * state.element_stride + column);
    }
}

}  // namespace

template <class Real>
ExtendedStorage<Real>::ExtendedStorage(const Grid& grid, double scale, double time_step_s, ExtendedState<Real>& state)
    : elements_(static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(state.element_stride)) {
  fill_constants(grid, scale, state);
  take_history(grid.laws, time_step_s, state);
}

/// One number per element.
template <class Real>
Real* ExtendedStorage<Real>::take(double value) {
  return arrays_.emplace_back(elements_, static_cast<Real>(value)).data();
}

template <class Real>
void ExtendedStorage<Real>::fill_constants(const Grid& grid, double scale, ExtendedState<Real>& state) {
  const GridLaws& laws = grid.laws;
  if (!laws.eigenstrain.empty()) state.eigenstrain = take(0.0);
  if (!laws.inverse_limit.empty()) state.inverse_limit = take(0.0);
  if (!laws.yield_pa.empty()) state.flow_strain = take(kNever<double>);
  if (laws.softening > 0.0) state.onset = take(kNever<double>);
  for_every_element(grid, state, [&](int element, int at) {
    if (state.eigenstrain) state.eigenstrain[at] = static_cast<Real>(laws.eigenstrain[element]);
    if (state.inverse_limit) state.inverse_limit[at] = static_cast<Real>(laws.inverse_limit[element]);
    if (state.flow_strain)
      state.flow_strain[at] = static_cast<Real>(laws.yield_pa[element] * scale / (2.0 * state.mu[at]));
    if (state.onset) state.onset[at] = static_cast<Real>(2.0 * grid.threshold_j_per_m3[element] * scale);
  });
}

template <class Real>
void ExtendedStorage<Real>::take_history(const GridLaws& laws, double time_step_s, ExtendedState<Real>& state) {
  if (state.onset) {
    state.softening = static_cast<Real>(laws.softening);
    state.integrity = take(1.0);
  }
  state.tension_only = static_cast<Real>(laws.tension_only);
  if (state.flow_strain)
    for (auto& point : state.plastic)
      for (Real*& component : point) component = take(0.0);
  if (laws.overstress == 0.0 || time_step_s == 0.0) return;
  for (auto& point : state.branch)
    for (Real*& component : point) component = take(0.0);
  const double steps = time_step_s / laws.relaxation_time_s;
  state.overstress = static_cast<Real>(laws.overstress);
  state.branch_kept = static_cast<Real>(std::exp(-steps));
  state.branch_gain = static_cast<Real>(laws.overstress * -std::expm1(-steps) / steps);
}

template <class Real>
void erase_laws(ExtendedState<Real>& state, int element) {
  if (state.eigenstrain) state.eigenstrain[element] = Real{0};
  if (state.inverse_limit) state.inverse_limit[element] = Real{0};
  if (state.flow_strain) state.flow_strain[element] = kNever<Real>;
  if (state.onset) state.onset[element] = kNever<Real>;
  if (state.overstress == Real{0}) return;
  for (auto& point : state.branch)
    for (Real* component : point) component[element] = Real{0};
}

template <>
const ExtendedKernel<float>& extended_kernel<float>(SimdLevel level) {
  return level == SimdLevel::avx512 ? avx512::kExtendedSingle
         : level == SimdLevel::avx2 ? avx2::kExtendedSingle
                                    : baseline::kExtendedSingle;
}

template <>
const ExtendedKernel<double>& extended_kernel<double>(SimdLevel level) {
  return level == SimdLevel::avx512 ? avx512::kExtendedDouble
         : level == SimdLevel::avx2 ? avx2::kExtendedDouble
                                    : baseline::kExtendedDouble;
}

template class ExtendedStorage<float>;
template class ExtendedStorage<double>;
template void erase_laws<float>(ExtendedState<float>&, int);
template void erase_laws<double>(ExtendedState<double>&, int);

}  // namespace nacre::fem
