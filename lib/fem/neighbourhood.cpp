#include "fem/neighbourhood.hpp"

#include <cassert>
#include <cmath>
#include <limits>

namespace nacre::fem {
namespace {

/// Share of the mean that an element's own y must reach: less than 1, or a field that is uniform but for its last
/// digits, or a trace lower in the middle than around, would not fail where its mean passes 1.
constexpr double kOwnShare = 0.99;

std::vector<double> tent(double radius) {
  std::vector<double> weights;
  double sum = 0.0;
  for (int away = 0; away == 0 || away < radius; ++away) {
    weights.push_back(1.0 - away / radius);
    sum += (away == 0 ? 1.0 : 2.0) * weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

/// Place of an element of the grid in the state's arrays.
template <class Real>
int place_of(const ExtendedState<Real>& state, int element) {
  return element / state.columns * state.element_stride + element % state.columns;
}

}  // namespace

template <class Real>
Neighbourhood<Real>::Neighbourhood(double radius, ExtendedState<Real>& state) : weights_(tent(radius)) {
  assert(radius > 0.0);
  for (int at = 0; at < state.rows * state.element_stride; ++at) {
    inverse_strengths_.push_back(Real{1} / state.threshold[at]);
    if (state.onset) state.onset[at] = std::numeric_limits<Real>::infinity();
  }
}

template <class Real>
double Neighbourhood<Real>::ratio(const ExtendedState<Real>& state, int row, int column) const {
  if (column < 0 || column >= state.columns) return 0.0;
  const int at = row * state.element_stride + column;
  return inverse_strengths_[at] == Real{0} ? 0.0 : static_cast<double>(state.energy[at] * inverse_strengths_[at]);
}

template <class Real>
double Neighbourhood<Real>::row_mean(const ExtendedState<Real>& state, int row, int column) const {
  if (row < 0 || row >= state.rows) return 0.0;
  double sum = weights_[0] * ratio(state, row, column);
  for (int away = 1; away < static_cast<int>(weights_.size()); ++away)
    sum += weights_[away] * (ratio(state, row, column - away) + ratio(state, row, column + away));
  return sum;
}

template <class Real>
double Neighbourhood<Real>::mean_around(const ExtendedState<Real>& state, int row, int column) const {
  double sum = weights_[0] * row_mean(state, row, column);
  for (int away = 1; away < static_cast<int>(weights_.size()); ++away)
    sum += weights_[away] * (row_mean(state, row - away, column) + row_mean(state, row + away, column));
  return sum;
}

/// True also where a value is not a number, so that the solver looks at the element.
template <class Real>
bool Neighbourhood<Real>::fails(const ExtendedState<Real>& state, int element) const {
  const int row = element / state.columns, column = element % state.columns;
  const double mean = mean_around(state, row, column);
  return !(mean < 1.0) && !(ratio(state, row, column) < kOwnShare * mean);
}

template <class Real>
void Neighbourhood<Real>::keep_failing(ExtendedState<Real>& state) {
  int kept = 0;
  for (int i = 0; i < state.failed_count; ++i) {
    const int element = state.failed[i], at = place_of(state, element);
    const bool softens = state.onset && !std::isinf(state.onset[at]);
    if (!softens && !fails(state, element)) continue;
    if (state.onset && !softens) {
      const Real last = Real{1} + state.softening;
      state.onset[at] = state.energy[at];
      state.threshold[at] = state.energy[at] * last * last;
      continue;
    }
    state.failed[kept++] = element;
  }
  state.failed_count = kept;
  // What failed is empty from the next step on: it counts nowhere any more.
  for (int i = 0; i < kept; ++i) inverse_strengths_[place_of(state, state.failed[i])] = Real{0};
}

template class Neighbourhood<float>;
template class Neighbourhood<double>;

}  // namespace nacre::fem
